// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "asterism/core/output_file.hpp"
#include "asterism/measurement/label.hpp"
#include "asterism/measurement/point.hpp"

namespace asterism {

/// The points of one frame, in the order of their `point` column.
struct FramePoints {
  int frame = 0;
  std::vector<Point> points;
};

/// Only `frame,point,x_mm,y_mm,z_mm` must be there. Points must count from 0 without gaps in each
/// frame. A covariance that is not given is zero: not known.
[[nodiscard]] std::vector<FramePoints> read_points(const std::filesystem::path& file);

/// Writes frames as they come; the file is whole after finish.
class PointTable {
 public:
  explicit PointTable(const std::filesystem::path& file);
  void write(int frame, const std::vector<Point>& points);
  void flush() { file_.flush(); }
  void finish() { file_.finish(); }

 private:
  OutputFile file_;
};

}  // namespace asterism
