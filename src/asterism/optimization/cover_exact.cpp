// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/cover_exact.hpp"

#include <fmt/format.h>
#include <coin/CbcModel.hpp>
#include <coin/CglClique.hpp>
#include <coin/CglGomory.hpp>
#include <coin/CglKnapsackCover.hpp>
#include <coin/CglMixedIntegerRounding2.hpp>
#include <coin/CglProbing.hpp>
#include <coin/CglZeroHalf.hpp>
#include <coin/CoinError.hpp>
#include <coin/OsiClpSolverInterface.hpp>

#include <algorithm>
#include <chrono>
#include <limits>

namespace asterism {
namespace {

/// The integer program, column by column: x of the columns, z of the groups, y of the rows.
class Program {
 public:
  explicit Program(const CoverModel& model) : model_(model) {
    share_row_ = model.rows();
    const std::size_t first_link = model.rows() + (model.is_partial() ? 1 : 0);
    std::vector<std::vector<std::size_t>> links(model.group_cost.size());
    std::size_t rows = first_link;
    for (std::size_t j = 0; j < model.columns(); ++j) {
      for (const std::uint32_t i : model.rows_of[j]) entry(i, 1);
      if (model.group[j] != kNoGroup) {
        links[model.group[j]].push_back(rows);
        entry(rows++, -1);
      }
      variable(model.cost[j], true);
    }
    for (std::size_t g = 0; g < model.group_cost.size(); ++g) {
      for (const std::size_t link : links[g]) entry(link, 1);
      variable(model.group_cost[g], true);
    }
    if (model.is_partial()) add_rows_wanted();
    add_limits(rows);
  }

  void load(OsiClpSolverInterface& solver) const {
    const CoinPackedMatrix matrix(true, static_cast<int>(least_.size()), static_cast<int>(cost_.size()),
                                  static_cast<CoinBigIndex>(value_.size()), value_.data(), row_.data(),
                                  start_.data(), nullptr);
    const std::vector<double> zero(cost_.size(), 0), one(cost_.size(), 1), most(least_.size(), COIN_DBL_MAX);
    solver.loadProblem(matrix, zero.data(), one.data(), cost_.data(), least_.data(), most.data());
    for (std::size_t k = 0; k < whole_.size(); ++k)
      if (whole_[k] != 0) solver.setInteger(static_cast<int>(k));
  }

  [[nodiscard]] std::size_t entries() const { return value_.size(); }

 private:
  void entry(std::size_t row, double value) {
    row_.push_back(static_cast<int>(row));
    value_.push_back(value);
  }

  void variable(double cost, bool whole) {
    cost_.push_back(cost);
    whole_.push_back(whole ? 1 : 0);
    start_.push_back(static_cast<CoinBigIndex>(value_.size()));
  }

  /// A row that demands one column is whole by itself. Weights are given in means of a row.
  void add_rows_wanted() {
    for (std::size_t i = 0; i < model_.rows(); ++i) {
      entry(i, -model_.demand[i]);
      entry(share_row_, in_means(model_.weight[i]));
      variable(0, model_.demand[i] > 1);
    }
  }

  void add_limits(std::size_t rows) {
    least_.assign(rows, 0);
    if (model_.is_partial())
      least_[share_row_] = in_means(model_.target);
    else
      std::copy(model_.demand.begin(), model_.demand.end(), least_.begin());
  }

  [[nodiscard]] double in_means(std::int64_t weight) const {
    return static_cast<double>(weight) / static_cast<double>(model_.total) *
           static_cast<double>(model_.rows());
  }

  const CoverModel& model_;
  std::size_t share_row_;
  std::vector<CoinBigIndex> start_{0};
  std::vector<int> row_;
  std::vector<double> value_, cost_, least_;
  std::vector<char> whole_;
};

/// What is searched for: covers that cost at most `most`. When there are none, none costs less than `beyond`.
struct Wanted {
  double most, beyond;
};

Wanted better_than(const CoverModel& model, double cost, double gap) {
  const bool whole = rounded_up(model, 0.5) == 1;
  const double better = whole ? cost - 1 : cost * (1 - 1e-9);
  const double enough = cost * (1 - gap);
  return enough < better ? Wanted{enough, rounded_up(model, enough)} : Wanted{better, cost};
}

/// Without the columns that make any cover dearer than is wanted, by the prices of the dual bound.
std::vector<char> worth_keeping(const CoverModel& model, const CoverPrices& prices, double most) {
  std::vector<char> keep(model.columns(), 1);
  for (std::size_t j = 0; j < model.columns(); ++j) {
    double reduced = model.cost[j];
    for (const std::uint32_t i : model.rows_of[j]) reduced -= prices.price[i];
    if (prices.bound + reduced > most + 1e-6) keep[j] = 0;
  }
  return keep;
}

/// The same by the linear relaxation; what no wanted cover can miss stays in.
void fix_by_reduced_cost(OsiClpSolverInterface& solver, std::size_t columns, double most) {
  const double slack = most - solver.getObjValue() + 1e-6;
  const std::vector<double> reduced(solver.getReducedCost(), solver.getReducedCost() + columns);
  for (std::size_t j = 0; j < columns; ++j) {
    if (reduced[j] > slack) solver.setColUpper(static_cast<int>(j), 0);
    if (reduced[j] < -slack) solver.setColLower(static_cast<int>(j), 1);
  }
}

/// Where to stop. An iteration's time goes with the rows: some 6 million rows a second on a processor of
/// 2020.
struct Effort {
  int iterations = std::numeric_limits<int>::max();
  double seconds;
};

Effort effort_for(const SetCoverOptions& options, int rows) {
  if (!options.exact_deterministic) return {std::numeric_limits<int>::max(), options.exact_s};
  constexpr double kRowsPerSecond = 6e6, kTooSlow = 3;
  const double iterations = options.exact_s * kRowsPerSecond / std::max(100, rows);
  return {static_cast<int>(std::min(iterations, 2e9)), options.exact_s * kTooSlow + 1};
}

void add_cuts(CbcModel& search, bool partial) {
  constexpr int kWhileItHelps = -1;
  CglProbing probing;
  probing.setUsingObjective(1);
  probing.setMaxPassRoot(1);
  probing.setMaxProbeRoot(50);
  probing.setMaxLookRoot(50);
  CglGomory gomory;
  gomory.setLimit(300);
  CglClique clique;
  clique.setStarCliqueReport(false);
  clique.setRowCliqueReport(false);
  CglZeroHalf half;
  CglMixedIntegerRounding2 rounding;
  CglKnapsackCover knapsack;
  search.addCutGenerator(&probing, kWhileItHelps, "probing");
  search.addCutGenerator(&gomory, kWhileItHelps, "gomory");
  search.addCutGenerator(&clique, kWhileItHelps, "clique");
  search.addCutGenerator(&half, kWhileItHelps, "zero half");
  search.addCutGenerator(&rounding, kWhileItHelps, "rounding");
  if (partial) search.addCutGenerator(&knapsack, kWhileItHelps, "knapsack");
}

std::string words_of(const CbcModel& search) {
  const auto nodes =
      fmt::format("after {} node{}", search.getNodeCount(), search.getNodeCount() == 1 ? "" : "s");
  if (search.status() == 0) return "optimal " + nodes;
  const bool clock = search.isSecondsLimitReached();
  return fmt::format("stopped by {} {}", clock ? "the clock" : "its count of iterations", nodes);
}

class ExactSearch {
 public:
  ExactSearch(const CoverModel& model, double start_cost, const SetCoverOptions& options)
      : model_(model), options_(options), wanted_(better_than(model, start_cost, options.gap)) {}

  void run(ExactCover& result, const Progress& progress) {
    progress("linear relaxation", 0, 1);
    const auto begin = std::chrono::steady_clock::now();
    try {
      if (!relax(result)) return;
      const std::chrono::duration<double> used = std::chrono::steady_clock::now() - begin;
      progress("exact search", 0, 1);
      branch(result, used.count());
    } catch (const CoinError& error) {  // the cover and the bound that are there hold all the same
      result.words = "broke off: " + error.message();
    }
  }

 private:
  /// False when the linear relaxation decides, or does not end.
  bool relax(ExactCover& result) {
    // CBC's own messages go nowhere
    solver_.messageHandler()->setLogLevel(0);
    solver_.getModelPtr()->setLogLevel(0);
    Program(model_).load(solver_);
    effort_ = effort_for(options_, solver_.getNumRows());
    solver_.setIntParam(OsiMaxNumIteration, effort_.iterations);
    solver_.getModelPtr()->setMaximumSeconds(effort_.seconds);
    solver_.initialSolve();
    if (!solver_.isProvenOptimal() && !solver_.isProvenPrimalInfeasible()) {
      result.words = "stopped in the linear relaxation";
      return false;
    }
    const double reached = solver_.isProvenPrimalInfeasible() ? wanted_.beyond : solver_.getObjValue();
    result.bound = std::max(result.bound, std::min(reached, wanted_.beyond));
    if (rounded_up(model_, reached) <= wanted_.most) return true;
    result.bound = wanted_.beyond;
    result.words =
        options_.gap > 0 ? "within the gap by the linear relaxation" : "optimal by the linear relaxation";
    return false;
  }

  void branch(ExactCover& result, double used_s) {
    fix_by_reduced_cost(solver_, model_.columns(), wanted_.most);
    effort_.iterations -= solver_.getIterationCount();
    solver_.setIntParam(OsiMaxNumIteration, std::numeric_limits<int>::max());
    solver_.getModelPtr()->setMaximumSeconds(-1);
    CbcModel search(solver_);
    search.setLogLevel(0);
    search.solver()->messageHandler()->setLogLevel(0);
    add_cuts(search, model_.is_partial());
    search.setCutoff(wanted_.most + 1e-6);
    search.setAllowableFractionGap(options_.gap);
    search.setMaximumNumberIterations(std::max(1, effort_.iterations));
    search.setMaximumSeconds(std::max(0.1, effort_.seconds - used_s));
    search.solver()->setIntParam(OsiMaxNumIterationHotStart, 50);
    search.setNumberStrong(5);
    search.setNumberBeforeTrust(2);
    search.setMaximumCutPassesAtRoot(20);
    search.setMaximumCutPasses(1);
    search.branchAndBound();
    result.words = words_of(search);
    take_better(search, result);
  }

  void take_better(const CbcModel& search, ExactCover& result) const {
    const bool ended = search.status() == 0;
    const double* values = search.bestSolution();
    if (values == nullptr) {
      const double reached = ended ? wanted_.beyond : search.getBestPossibleObjValue();
      result.bound = std::max(result.bound, std::min(reached, wanted_.beyond));
      return;
    }
    const double reached =
        ended && options_.gap == 0 ? search.getObjValue() : search.getBestPossibleObjValue();
    result.bound = std::max(result.bound, std::min(reached, search.getObjValue()));
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t j = 0; j < model_.columns(); ++j)
      if (values[j] > 0.5) chosen.push_back(j);
    if (covered_weight(model_, chosen) >= model_.target) result.chosen = std::move(chosen);
  }

  const CoverModel& model_;
  const SetCoverOptions& options_;
  Wanted wanted_;
  Effort effort_{};
  OsiClpSolverInterface solver_;
};

}  // namespace

ExactCover exact_cover(const CoverModel& model, std::span<const std::uint32_t> start,
                       const CoverPrices& prices, const SetCoverOptions& options, const Progress& progress) {
  ExactCover result{{}, prices.bound, ""};
  const double start_cost = cost_of(model, start);
  const Wanted wanted = better_than(model, start_cost, options.gap);
  const std::vector<char> keep = worth_keeping(model, prices, wanted.most);
  std::vector<std::uint32_t> column;
  for (std::uint32_t j = 0; j < model.columns(); ++j)
    if (keep[j] != 0) column.push_back(j);
  const CoverModel part = part_of(model, std::vector<char>(model.rows(), 1), keep);
  ExactSearch(part, start_cost, options).run(result, progress);
  for (std::uint32_t& j : result.chosen) j = column[j];
  if (result.chosen.empty() || cost_of(model, result.chosen) >= start_cost)
    result.chosen.assign(start.begin(), start.end());
  return result;
}

}  // namespace asterism
