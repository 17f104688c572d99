// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

struct BoardPoint {
  int point;  // index into board_points
  Vec2 px;    // chessboard: the corner; circles: the centre of the ellipse, not corrected for perspective
  Mat2 covariance;  // px²
};

/// What one camera saw of the board in one image.
struct BoardView {
  std::vector<BoardPoint> points;
  double pitch_px = 0;  // median distance of neighbours
  double blur_px = 0;   // chessboard: median blur (standard deviation) of the edges
  /// Circles: diameter over pitch as the images show it (area of the ellipse over that of the grid cell),
  /// for boards whose circle diameter was not told; 0 = not known.
  double diameter_of_pitch = 0;
};

}  // namespace asterism
