// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/geometry/types.hpp"

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

/// Without their names.
[[nodiscard]] std::vector<std::vector<Vec3>> places_of(const std::vector<PublishedLayout>& layouts);

}  // namespace asterism
