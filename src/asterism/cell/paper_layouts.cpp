// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/paper_layouts.hpp"

#include <fmt/format.h>

#include <cmath>

namespace asterism {

const std::vector<PublishedLayout>& paper_table1() {
  static const std::vector<PublishedLayout> layouts = {
      {"Table 1 S1",
       {{250, 0, 600}, {0, 300, 610}, {-250, 0, 590}, {0, -300, 605}, {220, 220, 580}, {-220, -220, 605}}},
      {"Table 1 S2",
       {{300, 100, 610},
        {100, 320, 620},
        {-300, 80, 590},
        {-120, -280, 600},
        {230, 240, 590},
        {-240, -200, 610}}},
      {"Table 1 S3",
       {{200, -100, 590},
        {-100, 300, 610},
        {-200, 100, 600},
        {0, -250, 605},
        {210, 180, 580},
        {-200, -240, 590}}}};
  return layouts;
}

const std::vector<PublishedLayout>& paper_table9() {
  static const std::vector<PublishedLayout> layouts = {
      {"Table 9 S1", {{250, 0, 600}, {0, 300, 610}, {-250, 0, 590}, {0, -300, 605}}},
      {"Table 9 S2", {{350, 350, 600}, {-350, 350, 610}, {-350, -350, 590}, {350, -350, 605}}},
      {"Table 9 S3", {{500, 0, 620}, {0, 680, 600}, {-500, 0, 610}, {0, -680, 605}}},
      {"Table 9 S4", {{220, 220, 580}, {220, -220, 590}, {-220, 220, 595}, {-220, -220, 605}}},
      {"Table 9 S5", {{600, 100, 610}, {100, 600, 600}, {-600, -100, 590}, {-100, -600, 620}}}};
  return layouts;
}

std::vector<Target> targets_of(const PublishedLayout& layout, double tilt_rad, double diameter_mm) {
  std::vector<Target> targets;
  for (const Vec3& place : layout.targets) {
    Vec3 outwards(place.x(), place.y(), 0);
    if (outwards.norm() > 0) outwards.normalize();
    const Vec3 normal = std::sin(tilt_rad) * outwards + Vec3(0, 0, std::cos(tilt_rad));
    targets.push_back({fmt::format("P{}", targets.size() + 1), place, normal.normalized(), diameter_mm, {}});
  }
  return targets;
}

std::vector<std::vector<Vec3>> places_of(const std::vector<PublishedLayout>& layouts) {
  std::vector<std::vector<Vec3>> places;
  for (const PublishedLayout& layout : layouts) places.push_back(layout.targets);
  return places;
}

}  // namespace asterism
