// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/cell/shape.hpp"

namespace asterism {

/// Whether the straight way between two points meets the solid; all in the solid's frame, mm.
[[nodiscard]] bool blocks(const Shape& shape, const Vec3& from, const Vec3& to);

/// A ball that holds the solid, in its frame.
struct Ball {
  Vec3 centre;
  double radius_mm;
};
[[nodiscard]] Ball ball_around(const Shape& shape);

/// Distance between the segments a0–a1 and b0–b1; either may be a point.
[[nodiscard]] double segment_distance(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);

}  // namespace asterism
