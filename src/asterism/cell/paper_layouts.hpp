// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/cell/body.hpp"

namespace asterism {

/// A layout that was published, as centres in the platform's frame, mm.
struct PublishedLayout {
  std::string name;
  std::vector<Vec3> targets;
};

/// Schemes S1 to S3 of Machines 2025, 13, 592, Table 1: six targets each.
[[nodiscard]] const std::vector<PublishedLayout>& paper_table1();

/// Schemes S1 to S5 of its Table 9: four targets each. S4's second target stands at x = +220: with the
/// printed −220 none of its other figures (Tables 10 and 11) comes out.
[[nodiscard]] const std::vector<PublishedLayout>& paper_table9();

/// As targets P1, P2, … that face up, tilted outwards from the platform's axis as in the paper's Figure 20.
[[nodiscard]] std::vector<Target> targets_of(const PublishedLayout& layout, double tilt_rad,
                                             double diameter_mm);

/// Without their names.
[[nodiscard]] std::vector<std::vector<Vec3>> places_of(const std::vector<PublishedLayout>& layouts);

}  // namespace asterism
