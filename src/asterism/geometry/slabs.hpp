// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// Six pairs of planes that hold a surface between them: across the frame's axes and across its own principal
/// axes. They tell at once what cannot be in the way.
struct Slabs {
  std::array<Vec3, 6> axes;         // unit
  std::array<double, 6> low, high;  // mm along each; low > high for an empty surface
};
[[nodiscard]] Slabs slabs_of(const TriangleMesh& surface);

/// Can nothing between the slabs meet a way from a disc to the eye? What they cannot tell may be free all the
/// same. 0.01 mm is allowed for rounding. A disc of no radius is a point, whatever its normal.
[[nodiscard]] bool out_of_reach(const Slabs& slabs, const Vec3& disc_centre, const Vec3& disc_normal,
                                double radius_mm, const Vec3& eye);

}  // namespace asterism
