// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/scanner.hpp"

namespace asterism {

void describe(Scanner& scanner, OptionVisitor& visit) {
  constexpr Limits kSize = {1, 1e5};
  visit.text("body", scanner.body, "the body that carries it");
  visit.number("stand_off_mm", scanner.stand_off_mm, kSize, "best distance");
  visit.number("near_mm", scanner.near_mm, kSize, "nearest distance");
  visit.number("far_mm", scanner.far_mm, kSize, "farthest distance");
  visit.number("field_width_mm", scanner.field_width_mm, kSize, "width of its field at the best distance");
  visit.number("field_height_mm", scanner.field_height_mm, kSize, "height of its field there");
  visit.number("max_incidence_deg", scanner.max_incidence_deg, {1, 90},
               "largest angle between the surface's normal and its line of sight");
}

}  // namespace asterism
