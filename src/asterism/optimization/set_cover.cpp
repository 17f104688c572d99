// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/set_cover.hpp"

#include <algorithm>

#include "asterism/core/result.hpp"
#include "asterism/optimization/cover_bound.hpp"
#include "asterism/optimization/cover_greedy.hpp"
#include "asterism/optimization/cover_model.hpp"

namespace asterism {
namespace {

/// What the rows weigh, in the problem's own weights; `chosen` = nullptr: all columns.
double weight_of_covered(const SetCoverProblem& problem, const std::vector<std::uint32_t>* chosen) {
  std::vector<int> able(problem.rows, 0), count(problem.rows, 0);
  for (const auto& column : problem.columns)
    for (const std::uint32_t row : column) ++able[row];
  if (chosen != nullptr)
    for (const std::uint32_t j : *chosen)
      for (const std::uint32_t row : problem.columns[j]) ++count[row];
  double weight = 0;
  for (std::size_t i = 0; i < problem.rows; ++i) {
    const int demand = std::min(able[i], problem.demand.empty() ? 1 : problem.demand[i]);
    if (demand > 0 && (chosen == nullptr || count[i] >= demand))
      weight += problem.weight.empty() ? 1 : problem.weight[i];
  }
  return weight;
}

}  // namespace

void describe(SetCoverOptions& options, OptionVisitor& visit) {
  visit.integer("local_steps", options.local_steps, {0, 2e9}, "steps of the local search; 0: none");
  visit.number("exact_s", options.exact_s, {0, 1e6}, "time for the exact search in s; 0: none");
  visit.number("gap", options.gap, {0, 1}, "relative gap to the bound that is good enough");
  visit.flag("exact_deterministic", options.exact_deterministic,
             "end the exact search by counts of nodes, not by the clock, so that results repeat");
}

SetCover solve(const SetCoverProblem& problem, const SetCoverOptions& options, std::uint64_t /*seed*/,
               const Progress& progress) {
  SetCoverOptions checked = options;
  LimitsCheck limits;
  describe(checked, limits);
  const CoverModel model = model_of(problem);

  SetCover result;
  result.rows_left = model.rows();
  result.columns_left = model.columns();
  progress("choosing greedily", 0, 1);
  const auto cover = without_needless(model, greedy_cover(model));
  result.cost = result.greedy_cost = result.local_cost = cost_of(model, cover);
  result.bound = std::min(result.cost, rounded_up(model, dual_bound(model, result.cost).bound));
  result.optimal = result.bound >= result.cost;
  result.exact = "not asked";
  result.chosen = in_order_of_gain(model, cover);
  result.covered = weight_of_covered(problem, &result.chosen);
  result.coverable = weight_of_covered(problem, nullptr);
  return result;
}

}  // namespace asterism
