// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "asterism/camera/image.hpp"
#include "asterism/detection/threshold_map.hpp"
#include "asterism/geometry/types.hpp"

namespace asterism {

/// Pixels [begin, end) of row y that lie above the threshold.
struct Run {
  int y, begin, end;
};

struct PixelBox {
  int x_begin, y_begin, x_end, y_end;  // half open
};

/// Appends the runs of pixels [x_begin, x_end) of row y that lie above the threshold. `thresholds` has one
/// for each pixel of the row, or is null: then `level` holds for all.
template <class Grey>
void append_runs_of_row(const Raster<Grey>& image, int y, int x_begin, int x_end, const Grey* thresholds,
                        Grey level, Tone<Grey> tone, std::vector<Run>& runs);

/// A set of connected pixels (eight neighbours) by its moments.
struct Blob {
  PixelBox box{};
  double count = 0;
  Vec2 mean = Vec2::Zero();
  Mat2 covariance = Mat2::Zero();  // px², of the pixel centres
};

/// Joins runs, which must be sorted by rows and in each row from left to right, into blobs.
[[nodiscard]] std::vector<Blob> blobs_of(const std::vector<Run>& runs);

}  // namespace asterism
