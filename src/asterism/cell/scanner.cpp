// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/scanner.hpp"

#include <algorithm>

namespace asterism {

void describe(Scanner& scanner, OptionVisitor& visit) {
  constexpr Limits kSize = {1, 1e5};
  constexpr Limits kNoise = {0, 100};
  visit.text("body", scanner.body, "the body that carries it");
  visit.number("stand_off_mm", scanner.stand_off_mm, kSize, "best distance");
  visit.number("near_mm", scanner.near_mm, kSize, "nearest distance");
  visit.number("far_mm", scanner.far_mm, kSize, "farthest distance");
  visit.number("field_width_mm", scanner.field_width_mm, kSize, "width of its field at the best distance");
  visit.number("field_height_mm", scanner.field_height_mm, kSize, "height of its field there");
  visit.number("max_incidence_deg", scanner.max_incidence_deg, {1, 90},
               "largest angle between the surface's normal and its line of sight");
  visit.number("good_incidence_deg", scanner.good_incidence_deg, {1, 90},
               "up to this angle a surface is measured well; beyond it plans warn");
  visit.number("baseline_mm", scanner.baseline_mm, {0, 1e4}, "from its projector to its camera, along x");
  visit.number("clearance_mm", scanner.clearance_mm, {0, 1e4},
               "radius about its origin that nothing may enter");
  visit.number("depth_sigma_mm", scanner.depth_sigma_mm, kNoise,
               "noise of a point along z at the best distance, square on");
  visit.number("lateral_sigma_mm", scanner.lateral_sigma_mm, kNoise, "noise across, at the best distance");
  visit.number("outlier_share", scanner.outlier_share, {0, 1}, "share of points that are wrong");
  visit.number("outlier_mm", scanner.outlier_mm, kNoise, "by up to so much");
  visit.integer("lines", scanner.lines, {1, 10000},
                "lines of one sweep across the field's width, each along its y");
  visit.integer("points_a_line", scanner.points_a_line, {1, 10000},
                "points of one line, across the field's height");
  visit.number("sweep_s", scanner.sweep_s, {0, 1000}, "from the first line of a sweep to its last");
  visit.number("place_sigma_mm", scanner.place_sigma_mm, kNoise, "of its place on its body, each axis");
  visit.number("place_sigma_deg", scanner.place_sigma_deg, {0, 10}, "of its attitude on its body, each axis");
}

RangeNoise range_noise(const Scanner& scanner, double z_mm, double cos_incidence) {
  constexpr double kGrazing = 0.05;  // nothing is measured there anyway
  const double share = z_mm / scanner.stand_off_mm;
  return {scanner.lateral_sigma_mm * share,
          scanner.depth_sigma_mm * share * share / std::max(cos_incidence, kGrazing)};
}

}  // namespace asterism
