// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asterism/cell/body.hpp"
#include "asterism/core/output_file.hpp"
#include "asterism/measurement/label.hpp"

namespace asterism {

/// One row of a labels CSV; body and target are empty for a point that is nobody's.
struct LabelRow {
  int frame = 0;
  int point = 0;
  std::string body, target;
  LabelStatus status = LabelStatus::Ok;
  double margin_mm = 0;
};

[[nodiscard]] std::vector<LabelRow> read_labels(const std::filesystem::path& file);

/// Writes a row for every point of a frame as frames come; the file is whole after finish.
class LabelTable {
 public:
  LabelTable(const std::filesystem::path& file, std::vector<Body> bodies);
  void write(int frame, std::size_t points, const std::vector<BodyLabels>& labels);
  void finish() { file_.finish(); }

 private:
  OutputFile file_;
  std::vector<Body> bodies_;
};

}  // namespace asterism
