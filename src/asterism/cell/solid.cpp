// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/solid.hpp"

#include <cmath>
#include <numbers>

namespace asterism {
namespace {

/// A closed cylinder that stands out of the wall, its axis level and pointing away from z.
TriangleMesh boss_at(const CasingShape& casing, double angle_rad) {
  const double height = 0.5 * casing.height_mm;
  const double wall = 0.5 * (casing.bottom_radius_mm + casing.top_radius_mm);
  const double root = wall - 0.5 * casing.wall_mm;
  const double length = wall + casing.boss_height_mm - root;
  const double r = casing.boss_radius_mm;
  const TriangleMesh upright = surface_of_revolution({{0, 0}, {r, 0}, {r, length}, {0, length}}, 48);
  const Vec3 outwards(std::cos(angle_rad), std::sin(angle_rad), 0);
  Mat3 axes;
  axes.col(0) = Vec3(-outwards.y(), outwards.x(), 0);
  axes.col(1) = Vec3::UnitZ();
  axes.col(2) = outwards;
  return moved(upright, {quaternion_from_matrix(axes), root * outwards + Vec3(0, 0, height)});
}

}  // namespace

void describe(CasingShape& shape, OptionVisitor& visit) {
  constexpr Limits kSize = {0.1, 1e5};
  constexpr Limits kOrNone = {0, 1e5};
  visit.number("bottom_radius_mm", shape.bottom_radius_mm, kSize, "outer radius below");
  visit.number("top_radius_mm", shape.top_radius_mm, kSize, "outer radius above");
  visit.number("height_mm", shape.height_mm, kSize, "height along z");
  visit.number("wall_mm", shape.wall_mm, kSize, "thickness of the wall");
  visit.number("flange_width_mm", shape.flange_width_mm, kOrNone,
               "of both flanges, beyond the wall; 0 = none");
  visit.number("flange_height_mm", shape.flange_height_mm, kSize, "thickness of the flanges");
  visit.integer("bosses", shape.bosses, {0, 1000}, "cylindrical bosses around the outside, halfway up");
  visit.number("boss_radius_mm", shape.boss_radius_mm, kSize, "radius of a boss");
  visit.number("boss_height_mm", shape.boss_height_mm, kSize, "by how much a boss stands out");
  visit.integer("sides", shape.sides, {12, 3600}, "of the polygon that stands for a circle");
}

TriangleMesh mesh_of(const CasingShape& casing) {
  const double slope = (casing.top_radius_mm - casing.bottom_radius_mm) / casing.height_mm;
  const auto outer = [&](double z) { return casing.bottom_radius_mm + slope * z; };
  const auto inner = [&](double z) { return outer(z) - casing.wall_mm; };
  const double top = casing.height_mm;
  std::vector<ProfilePoint> profile;
  if (casing.flange_width_mm > 0) {
    const double low = casing.flange_height_mm, high = top - casing.flange_height_mm;
    profile = {{outer(0) + casing.flange_width_mm, 0},
               {outer(0) + casing.flange_width_mm, low},
               {outer(low), low},
               {outer(high), high},
               {outer(top) + casing.flange_width_mm, high},
               {outer(top) + casing.flange_width_mm, top}};
  } else {
    profile = {{outer(0), 0}, {outer(top), top}};
  }
  profile.push_back({inner(top), top});
  profile.push_back({inner(0), 0});
  TriangleMesh mesh = surface_of_revolution(profile, casing.sides);
  for (int i = 0; i < casing.bosses; ++i) {
    append(mesh, boss_at(casing, 2 * std::numbers::pi * i / casing.bosses));
  }
  return mesh;
}

}  // namespace asterism
