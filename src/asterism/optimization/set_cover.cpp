// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/set_cover.hpp"

#include <algorithm>

#include "asterism/core/result.hpp"
#include "asterism/optimization/cover_bound.hpp"
#include "asterism/optimization/cover_exact.hpp"
#include "asterism/optimization/cover_greedy.hpp"
#include "asterism/optimization/cover_model.hpp"
#include "asterism/optimization/cover_reductions.hpp"
#include "asterism/optimization/cover_search.hpp"

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

/// In the problem's own numbers.
void finish(const SetCoverProblem& problem, const CoverModel& whole, const ReducedCover& reduction,
            const std::vector<std::uint32_t>& cover, SetCover& result) {
  std::vector<std::uint32_t> columns = reduction.forced;
  for (const std::uint32_t j : cover) columns.push_back(reduction.column[j]);
  std::sort(columns.begin(), columns.end());
  result.chosen = in_order_of_gain(whole, columns);
  result.cost = cost_of(whole, result.chosen);
  result.covered = weight_of_covered(problem, &result.chosen);
  result.coverable = weight_of_covered(problem, nullptr);
}

}  // namespace

void describe(SetCoverOptions& options, OptionVisitor& visit) {
  visit.integer("local_steps", options.local_steps, {0, 2e9}, "steps of the local search; 0: none");
  visit.number("exact_s", options.exact_s, {0, 1e6}, "time for the exact search in s; 0: none");
  visit.number("gap", options.gap, {0, 1}, "relative gap to the bound that is good enough");
  visit.flag("exact_deterministic", options.exact_deterministic,
             "end the exact search by counts of nodes, not by the clock, so that results repeat");
}

SetCover solve(const SetCoverProblem& problem, const SetCoverOptions& options, std::uint64_t seed,
               const Progress& progress) {
  SetCoverOptions checked = options;
  LimitsCheck limits;
  describe(checked, limits);
  const CoverModel whole = model_of(problem);
  progress("reducing the cover problem", 0, 1);
  const ReducedCover reduction = reduced(whole);
  const CoverModel& model = reduction.model;
  const double forced_cost = cost_of(whole, reduction.forced);

  SetCover result;
  result.rows_left = model.rows();
  result.columns_left = model.columns();
  auto cover = without_needless(model, greedy_cover(model));
  result.greedy_cost = forced_cost + cost_of(model, cover);
  const double first_bound = rounded_up(model, dual_bound(model, cost_of(model, cover)).bound);
  cover = searched_cover(model, cover, options.local_steps, first_bound, seed, progress);
  result.local_cost = forced_cost + cost_of(model, cover);

  progress("bounding the cover", 0, 1);
  const CoverPrices prices = dual_bound(model, cost_of(model, cover));  // a lower aim takes it higher
  double bound = std::max(first_bound, rounded_up(model, prices.bound));
  const double good_enough = (1 - options.gap) * result.local_cost;
  if (forced_cost + bound >= good_enough - 1e-9 * good_enough) {
    result.exact = "not needed";
  } else if (options.exact_s == 0) {
    result.exact = "not asked";
  } else {
    auto exact = exact_cover(model, cover, prices, options, progress);
    cover = std::move(exact.chosen);
    bound = std::max(bound, rounded_up(model, exact.bound));
    result.exact = std::move(exact.words);
  }
  finish(problem, whole, reduction, cover, result);
  result.bound = std::min(result.cost, forced_cost + bound);
  result.optimal = result.cost - result.bound <= 1e-9 * result.cost;
  if (result.optimal) result.bound = result.cost;
  return result;
}

}  // namespace asterism
