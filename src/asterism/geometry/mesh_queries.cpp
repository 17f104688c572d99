// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/mesh_queries.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double length2 = way.squaredNorm();
  const double share = length2 > 0 ? std::clamp((point - a).dot(way) / length2, 0.0, 1.0) : 0.0;
  return (point - a - share * way).norm();
}

/// The foot of the perpendicular when it falls inside, else the nearest edge.
double distance_to_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double length = normal.norm();
  if (length > 0) {
    const bool inside = normal.dot((b - a).cross(point - a)) >= 0 &&
                        normal.dot((c - b).cross(point - b)) >= 0 &&
                        normal.dot((a - c).cross(point - c)) >= 0;
    if (inside) return std::abs(normal.dot(point - a)) / length;
  }
  return std::min(
      {distance_to_segment(point, a, b), distance_to_segment(point, b, c), distance_to_segment(point, c, a)});
}

}  // namespace

double winding_number(const TriangleMesh& mesh, const Vec3& point) {
  double solid_angle = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - point;
    const Vec3 b = mesh.corner(t, 1) - point;
    const Vec3 c = mesh.corner(t, 2) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    solid_angle += 2 * std::atan2(a.dot(b.cross(c)), below);
  }
  return solid_angle / (4 * std::numbers::pi);
}

double distance_to(const TriangleMesh& mesh, const Vec3& point) {
  require(!mesh.empty(), "a distance is asked to a surface that has triangles");
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    nearest = std::min(nearest,
                       distance_to_triangle(point, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
  }
  return nearest;
}

}  // namespace asterism
