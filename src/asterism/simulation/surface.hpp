// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// A solid's surface made ready to be drawn, in the frame of what carries it; mm.
struct DrawnSurface {
  struct Triangle {
    std::array<std::uint32_t, 3> corner{};  // places
    std::array<Vec3, 3> normal;             // at the corners; outwards, not of unit length
  };
  int carrier = -1;  // a mover; −1 = stands in `tracker`
  std::vector<Vec3> places;
  std::vector<Triangle> triangles;
  double level = 0;     // where it is looked at squarely, share of full scale
  bool closed = false;  // then its inside is never seen
};

/// Normals are smooth across edges that turn by less than 30°. No edge is longer than `longest_mm` (0 = any):
/// triangles are drawn with straight sides, so a lens that bends lines asks for short ones.
[[nodiscard]] DrawnSurface drawn_surface(const TriangleMesh& mesh, int carrier, double level,
                                         double longest_mm);

}  // namespace asterism
