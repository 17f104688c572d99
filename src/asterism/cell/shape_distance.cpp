// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/shape_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace asterism {
namespace {

double distance_of(const Box& box, const Vec3& point) {
  const Vec3 beyond = point.cwiseAbs() - 0.5 * box.size_mm;
  return beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff());
}

double distance_of(const Capsule& capsule, const Vec3& point) {
  const Vec3 axis = capsule.to_mm - capsule.from_mm;
  const double length2 = axis.squaredNorm();
  const double along = length2 > 0 ? std::clamp(axis.dot(point - capsule.from_mm) / length2, 0.0, 1.0) : 0.0;
  return (point - capsule.from_mm - along * axis).norm() - capsule.radius_mm;
}

double distance_of(const Frustum& cone, const Vec3& point) {
  // In the half plane of the axis: the distance to the trapezium's rim, negative within.
  const Vec2 p(std::hypot(point.x(), point.y()), point.z());
  const std::array<Vec2, 4> rim = {Vec2(0, 0), Vec2(cone.bottom_radius_mm, 0),
                                   Vec2(cone.top_radius_mm, cone.height_mm), Vec2(0, cone.height_mm)};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < rim.size(); ++i) {
    const Vec2 edge = rim[i + 1] - rim[i];
    const double length2 = edge.squaredNorm();
    const double along = length2 > 0 ? std::clamp(edge.dot(p - rim[i]) / length2, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (p - rim[i] - along * edge).norm());
  }
  const double share = p.y() / cone.height_mm;
  const double radius = (1 - share) * cone.bottom_radius_mm + share * cone.top_radius_mm;
  const bool within = share >= 0 && share <= 1 && p.x() <= radius;
  return within ? -nearest : nearest;
}

}  // namespace

double distance_from(const Shape& shape, const Vec3& in_shape) {
  return std::visit([&](const auto& kind) { return distance_of(kind, in_shape); }, shape);
}

}  // namespace asterism
