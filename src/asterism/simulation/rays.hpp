// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "asterism/cell/shape.hpp"
#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// Whether the straight way between two points meets the solid; all in the solid's frame, mm.
[[nodiscard]] bool blocks(const Shape& shape, const Vec3& from, const Vec3& to);

/// A ball that holds the solid, in its frame.
struct Ball {
  Vec3 centre;
  double radius_mm;
};
[[nodiscard]] Ball ball_around(const Shape& shape);

/// How far a surface reaches along each of 26 directions (axes, edges and corners of a cube), mm.
struct Extent {
  std::array<double, 26> reach_mm{};
};
[[nodiscard]] Extent extent_of(const TriangleMesh& surface);

/// Whether a plane square to one of these directions has the surface on one side, the disc and the eye on
/// the other: then the surface hides nothing of the disc, and no ray need be asked.
[[nodiscard]] bool clear_of(const Extent& extent, const Vec3& disc_centre, const Vec3& disc_normal,
                            double radius_mm, const Vec3& eye);

/// Distance between the segments a0–a1 and b0–b1; either may be a point.
[[nodiscard]] double segment_distance(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);

}  // namespace asterism
