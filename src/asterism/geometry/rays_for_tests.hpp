// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "asterism/core/random.hpp"
#include "asterism/geometry/triangle_mesh.hpp"

// Ways to ask a surface about, and what tells whether one runs too near an edge to call.

namespace asterism::rays {

struct Way {
  Vec3 from, to;
};

inline Vec3 in_box(RandomStream& random, double half_mm) {
  return {half_mm * (2 * random.uniform() - 1), half_mm * (2 * random.uniform() - 1),
          half_mm * (2 * random.uniform() - 1)};
}

/// From a place on the surface, 0.5 mm before it, to somewhere 2.3 m from the origin.
inline Way from_surface(const TriangleMesh& mesh, RandomStream& random) {
  const auto triangle =
      static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(mesh.triangles.size())));
  const double a = std::sqrt(random.uniform()), b = random.uniform();
  const Vec3 at = (1 - a) * mesh.corner(triangle, 0) + a * (1 - b) * mesh.corner(triangle, 1) +
                  a * b * mesh.corner(triangle, 2);
  const double z = 2 * random.uniform() - 1, turn = 2 * std::numbers::pi * random.uniform();
  const double level = std::sqrt(1 - z * z);
  return {at + 0.5 * area_vector(mesh, triangle).normalized(),
          2300.0 * Vec3(level * std::cos(turn), level * std::sin(turn), z)};
}

/// Triangles of up to 200 mm anywhere within ±500 mm, and a way between two places there.
inline TriangleMesh soup(int triangles, RandomStream& random) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(triangles); ++i) {
    const Vec3 at = in_box(random, 500);
    for (int corner = 0; corner < 3; ++corner) mesh.vertices.emplace_back(at + in_box(random, 100));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}
inline Way within_soup(RandomStream& random) { return {in_box(random, 500), in_box(random, 500)}; }

/// The same way moved by `by_mm` to either side in two directions across it, and made so much longer or
/// shorter at either end: where these answers differ, an edge is no farther than that.
template <class Blocked>
bool near_edge(const Way& way, double by_mm, const Blocked& blocked) {
  const Vec3 along = by_mm * (way.to - way.from).normalized();
  const Vec3 across = by_mm * along.unitOrthogonal();
  const Vec3 third = along.cross(across) / by_mm;
  const bool here = blocked(way.from, way.to);
  for (const double sign : {1.0, -1.0}) {
    for (const Vec3& shift : {across, third}) {
      if (blocked(way.from + sign * shift, way.to + sign * shift) != here) return true;
    }
    if (blocked(way.from + sign * along, way.to) != here) return true;
    if (blocked(way.from, way.to + sign * along) != here) return true;
  }
  return false;
}

}  // namespace asterism::rays
