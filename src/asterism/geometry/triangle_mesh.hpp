// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// A surface of triangles. Corners run counter-clockwise when seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;  // mm
  std::vector<std::array<std::uint32_t, 3>> triangles;

  [[nodiscard]] bool empty() const { return triangles.empty(); }
  [[nodiscard]] const Vec3& corner(std::size_t triangle, int which) const {
    return vertices[triangles[triangle][static_cast<std::size_t>(which)]];
  }
};

/// What can be told of a surface before anyone relies on it. An edge is shared by two triangles that run
/// along it in opposite senses; of every other kind there is a count.
struct MeshFacts {
  std::size_t vertices = 0, triangles = 0;
  std::size_t degenerate = 0;          // triangles without area
  std::size_t boundary_edges = 0;      // of one triangle alone: the surface is open there
  std::size_t non_manifold_edges = 0;  // of three triangles or more
  std::size_t flipped_edges = 0;       // of two triangles that run along it in the same sense
  double area_mm2 = 0;
  double volume_mm3 = 0;  // negative: the surface is inside out; means nothing while the surface is open
  Vec3 lowest = Vec3::Zero(), highest = Vec3::Zero();

  [[nodiscard]] bool closed() const {
    return triangles > 0 && boundary_edges == 0 && non_manifold_edges == 0 && flipped_edges == 0;
  }
  [[nodiscard]] double diagonal_mm() const { return (highest - lowest).norm(); }
};
[[nodiscard]] MeshFacts facts_of(const TriangleMesh& mesh);

/// Twice the triangle's area times its outward normal.
[[nodiscard]] Vec3 area_vector(const TriangleMesh& mesh, std::size_t triangle);

[[nodiscard]] TriangleMesh moved(TriangleMesh mesh, const RigidMotion& a_from_b);
[[nodiscard]] TriangleMesh scaled(TriangleMesh mesh, double factor);
/// The same surface, its inside out.
[[nodiscard]] TriangleMesh flipped(TriangleMesh mesh);
/// Both surfaces in one.
void append(TriangleMesh& mesh, const TriangleMesh& other);
/// Corners in one place become one vertex: files such as STL tell each triangle by itself.
[[nodiscard]] TriangleMesh welded(const TriangleMesh& mesh);

/// A point of an outline that is turned about the z axis: radius and height.
struct ProfilePoint {
  double radius_mm, height_mm;
};
/// The closed surface that a profile sweeps when turned about z, divided into `sides`. The profile runs so
/// that the solid lies on its left hand when radius is drawn to the right and height upwards (outer wall
/// upwards, then inwards along the top); its first and last points are joined. A point on the axis is a tip.
[[nodiscard]] TriangleMesh surface_of_revolution(const std::vector<ProfilePoint>& profile, int sides);

}  // namespace asterism
