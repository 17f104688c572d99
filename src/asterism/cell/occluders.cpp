// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/occluders.hpp"

#include <cmath>

namespace asterism {
namespace {

constexpr int kSides = 96;

TriangleMesh mesh_of_shape(const Box& box) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                    (corner & 4) != 0 ? 0.5 : -0.5);
    mesh.vertices.emplace_back(sign.cwiseProduct(box.size_mm));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriangleMesh mesh_of_shape(const Frustum& cone) {
  std::vector<ProfilePoint> profile;
  if (cone.bottom_radius_mm > 0) profile.push_back({0, 0});
  profile.push_back({cone.bottom_radius_mm, 0});
  profile.push_back({cone.top_radius_mm, cone.height_mm});
  if (cone.top_radius_mm > 0) profile.push_back({0, cone.height_mm});
  return surface_of_revolution(profile, kSides);
}

/// Half circles at both ends, turned about the line between them.
TriangleMesh mesh_of_shape(const Capsule& capsule) {
  constexpr int kQuarter = kSides / 4;
  const Vec3 way = capsule.to_mm - capsule.from_mm;
  const double length = way.norm();
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= 2 * kQuarter; ++i) {
    const double angle = std::numbers::pi * (i - kQuarter) / (2.0 * kQuarter);
    const double end = i <= kQuarter ? 0.0 : length;
    const bool tip = i == 0 || i == 2 * kQuarter;
    if (i == kQuarter && length > 0) profile.push_back({capsule.radius_mm, 0});
    profile.push_back({tip ? 0.0 : capsule.radius_mm * std::cos(angle),
                       (i == kQuarter ? length : end) + capsule.radius_mm * std::sin(angle)});
  }
  Mat3 axes;
  axes.col(2) = length > 0 ? Vec3(way / length) : Vec3(Vec3::UnitZ());
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return moved(surface_of_revolution(profile, kSides), {quaternion_from_matrix(axes), capsule.from_mm});
}

Occluder occluder_of(const Cell& cell, const Solid& solid) {
  return {solid.name, mover_index(cell, solid.body), moved(*solid.surface, solid.carrier_from_solid)};
}

}  // namespace

TriangleMesh mesh_of(const Shape& shape) {
  return std::visit([](const auto& one) { return mesh_of_shape(one); }, shape);
}

int mover_index(const Cell& cell, const std::string& body) {
  for (std::size_t i = 0; i < cell.movers.size(); ++i) {
    if (cell.movers[i].body.name == body) return static_cast<int>(i);
  }
  return -1;
}

std::vector<RigidMotion> poses_at(const Cell& cell, double time_s) {
  std::vector<RigidMotion> poses;
  for (const Mover& mover : cell.movers) poses.push_back(pose_at(mover.motion, time_s));
  return poses;
}

std::vector<Occluder> occluders_of(const Cell& cell) {
  std::vector<Occluder> occluders;
  if (cell.workpiece) occluders.push_back(occluder_of(cell, *cell.workpiece));
  for (const Solid& fixture : cell.fixtures) occluders.push_back(occluder_of(cell, fixture));
  for (const Obstacle& obstacle : cell.obstacles) {
    occluders.push_back({obstacle.name, mover_index(cell, obstacle.body),
                         moved(mesh_of(obstacle.shape), obstacle.carrier_from_shape)});
  }
  return occluders;
}

}  // namespace asterism
