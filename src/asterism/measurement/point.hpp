// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/geometry/types.hpp"

namespace asterism {

/// A candidate target in space: where the sight lines of one centre of each camera meet. A centre may
/// take part in several points; all but one of them are ghosts, which identification removes.
struct Point {
  Vec3 in_tracker;  // mm
  Mat3 covariance;  // mm²
  double epipolar_error_px = 0;
  int left = -1, right = -1;  // which centres; −1 when the point was read from a file without them
};

}  // namespace asterism
