// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/geometry/triangle_mesh.hpp"

// Slow and exact questions about a surface: each looks at every triangle in double precision, so nothing has
// to be built first. For many questions about one surface see ray_scene.hpp.

namespace asterism {

/// How often the surface goes around a point: 1 inside a closed surface that faces outwards, 0 outside, −1
/// inside one that is inside out; not a whole number where the surface is open, or the point lies on it.
/// Solid angles by van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.
[[nodiscard]] double winding_number(const TriangleMesh& mesh, const Vec3& point);

/// Distance from a point to the nearest point of the surface, mm; the surface is not empty.
[[nodiscard]] double distance_to(const TriangleMesh& mesh, const Vec3& point);

}  // namespace asterism
