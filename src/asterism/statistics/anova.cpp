// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/anova.hpp"

#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/statistics/distributions.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {

Anova one_way_anova(std::span<const std::vector<double>> groups) {
  require(groups.size() >= 2, "an analysis of variance takes two groups or more");
  // Everything is taken from the first value: many common leading digits cost nothing then.
  require(!groups.front().empty(), "no group may be empty");
  const double origin = groups.front().front();
  std::vector<double> all;
  std::vector<double> means;
  for (const std::vector<double>& group : groups) {
    require(!group.empty(), "no group may be empty");
    std::vector<double> shifted;
    for (const double value : group) shifted.push_back(value - origin);
    means.push_back(mean_of(shifted));
    all.insert(all.end(), shifted.begin(), shifted.end());
  }
  require(all.size() > groups.size(), "an analysis of variance takes more values than groups");

  const double mean = mean_of(all);
  std::vector<double> between, within;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    between.push_back(static_cast<double>(groups[g].size()) * (means[g] - mean) * (means[g] - mean));
    for (const double value : groups[g]) {
      const double rest = (value - origin) - means[g];
      within.push_back(rest * rest);
    }
  }
  Anova anova;
  anova.between_squares = exact_sum(between);
  anova.within_squares = exact_sum(within);
  require(anova.within_squares > 0, "an analysis of variance takes values that vary within the groups");
  anova.between_degrees = static_cast<double>(groups.size() - 1);
  anova.within_degrees = static_cast<double>(all.size() - groups.size());
  const double variance = anova.within_squares / anova.within_degrees;
  anova.f = anova.between_squares / anova.between_degrees / variance;
  anova.p = fisher_tail(anova.f, anova.between_degrees, anova.within_degrees);
  anova.r_squared = anova.between_squares / (anova.between_squares + anova.within_squares);
  anova.deviation = std::sqrt(variance);
  return anova;
}

}  // namespace asterism
