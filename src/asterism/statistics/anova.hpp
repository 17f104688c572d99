// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace asterism {

/// One-way analysis of variance: do the means of several groups differ?
struct Anova {
  double between_squares = 0, within_squares = 0;  // sums of squares
  double between_degrees = 0, within_degrees = 0;  // of freedom
  double f = 0;
  double p = 1;          // probability of such an F, or a larger one, without any difference
  double r_squared = 0;  // share of the variation that lies between the groups
  double deviation = 0;  // within the groups
};

/// Two groups or more, none empty, with more values than groups that are not all alike.
[[nodiscard]] Anova one_way_anova(std::span<const std::vector<double>> groups);

}  // namespace asterism
