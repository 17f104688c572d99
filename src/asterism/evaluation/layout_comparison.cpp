// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/layout_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

constexpr double kPower = 0.8;
constexpr double kMostRuns = 1e9;  // beyond, a difference is none

using Samples = std::vector<std::vector<double>>;  // by layout, then run

Samples samples_of(std::span<const LayoutRuns> layouts, RunQuantity quantity, bool at_rest) {
  Samples samples(layouts.size());
  const std::size_t runs = layouts.front().at_rest.size();
  for (std::size_t run = 0; run < runs; ++run) {
    const auto errors = [&](const LayoutRuns& layout) {
      return at_rest ? layout.at_rest[run] : layout.moving[run];
    };
    if (!std::all_of(layouts.begin(), layouts.end(), [&](const auto& l) { return errors(l).has_value(); }))
      continue;
    for (std::size_t i = 0; i < layouts.size(); ++i)
      samples[i].push_back((*errors(layouts[i]))[static_cast<std::size_t>(quantity)]);
  }
  return samples;
}

/// Not the same layout written down twice: in some run by more than digits that a file rounds away.
bool differ(std::span<const double> a, std::span<const double> b) {
  constexpr double kDigits = 1e-4;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > kDigits * (a[i] + b[i])) return true;
  }
  return false;
}

PairOfLayouts pair_of(const Samples& samples, std::size_t a, std::size_t b, std::size_t first) {
  PairOfLayouts pair{a, b, {}, {}, 1, 1, 0, {}};
  const std::span<const double> of_a = samples[a], of_b = samples[b];
  if (!differ(of_a, of_b)) return pair;
  pair.first = paired_t_test(of_a.first(first), of_b.first(first));
  pair.all = paired_t_test(of_a, of_b);
  const TTestPlan plan{std::abs(pair.all.effect_size)};
  // Runs needed grow as (2.8 / effect)².
  if (!(plan.effect_size > 2.8 / std::sqrt(kMostRuns))) return pair;
  pair.power_of_first = power_of_t_test(plan, first);
  pair.runs_needed = sample_size_for(plan, kPower);
  return pair;
}

void make_good(std::vector<PairOfLayouts>& pairs) {
  std::vector<double> first, all;
  for (const PairOfLayouts& pair : pairs) {
    first.push_back(pair.first.p);
    all.push_back(pair.all.p);
  }
  first = holm_adjusted(first);
  all = holm_adjusted(all);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].first_p_holm = first[i];
    pairs[i].all_p_holm = all[i];
  }
}

}  // namespace

LayoutComparison compare_layouts(std::span<const LayoutRuns> layouts, RunQuantity quantity, bool at_rest,
                                 std::size_t first) {
  require(!layouts.empty(), "one layout or more is compared");
  const Samples samples = samples_of(layouts, quantity, at_rest);
  LayoutComparison comparison{quantity, at_rest, 0, samples.front().size(), {}, {}};
  if (comparison.runs < 3) {
    throw MeasurementError(fmt::format("of {} disturbance runs {} gave every layout a pose",
                                       layouts.front().at_rest.size(), comparison.runs));
  }
  comparison.first_runs = std::min(first, comparison.runs);
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    const std::span<const double> all = samples[i];
    const Summary of_first = summarize(all.first(comparison.first_runs)), of_all = summarize(all);
    comparison.layouts.push_back(
        {layouts[i].name, of_first, of_all, mean_interval(of_first), mean_interval(of_all)});
  }
  for (std::size_t a = 0; a < layouts.size(); ++a) {
    for (std::size_t b = a + 1; b < layouts.size(); ++b)
      comparison.pairs.push_back(pair_of(samples, a, b, comparison.first_runs));
  }
  if (!comparison.pairs.empty()) make_good(comparison.pairs);
  return comparison;
}

}  // namespace asterism
