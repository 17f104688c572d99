// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/cover_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

[[noreturn]] void fail(const std::string& what) { throw InputError("set cover", what); }

void check_size(const char* name, std::size_t size, std::size_t wanted, const char* of) {
  if (size != 0 && size != wanted)
    fail(fmt::format("{} {} for {} {}; give one each or none", size, name, wanted, of));
}

void check_column(const SetCoverProblem& problem, std::size_t j) {
  const auto& column = problem.columns[j];
  for (std::size_t k = 0; k < column.size(); ++k) {
    if (column[k] >= problem.rows)
      fail(fmt::format("column {} covers row {}, but there are {} rows, counted from 0", j, column[k],
                       problem.rows));
    if (k > 0 && column[k] <= column[k - 1])
      fail(fmt::format("column {} names row {} after row {}; rows must ascend", j, column[k], column[k - 1]));
  }
  if (!problem.cost.empty() && !(problem.cost[j] > 0 && std::isfinite(problem.cost[j])))
    fail(fmt::format("column {} costs {}; a cost must be above 0", j, problem.cost[j]));
  if (!problem.group.empty() && problem.group[j] >= problem.group_cost.size())
    fail(fmt::format("column {} is of group {}, but {} groups have a cost", j, problem.group[j],
                     problem.group_cost.size()));
}

void check(const SetCoverProblem& problem) {
  const std::size_t columns = problem.columns.size();
  check_size("costs", problem.cost.size(), columns, "columns");
  check_size("groups", problem.group.size(), columns, "columns");
  check_size("weights", problem.weight.size(), problem.rows, "rows");
  check_size("demands", problem.demand.size(), problem.rows, "rows");
  for (std::size_t j = 0; j < columns; ++j) check_column(problem, j);
  for (std::size_t i = 0; i < problem.weight.size(); ++i)
    if (!(problem.weight[i] >= 0 && std::isfinite(problem.weight[i])))
      fail(fmt::format("row {} weighs {}; a weight must be 0 or more", i, problem.weight[i]));
  for (std::size_t i = 0; i < problem.demand.size(); ++i)
    if (problem.demand[i] < 0)
      fail(fmt::format("row {} demands {} columns; it must be 0 or more", i, problem.demand[i]));
  for (std::size_t g = 0; g < problem.group_cost.size(); ++g)
    if (!(problem.group_cost[g] >= 0 && std::isfinite(problem.group_cost[g])))
      fail(fmt::format("group {} costs {}; a cost must be 0 or more", g, problem.group_cost[g]));
  if (!(problem.share > 0 && problem.share <= 1))
    fail(fmt::format("a share of {} is to be covered; it must be above 0 and at most 1", problem.share));
}

bool is_whole(double value) { return value == std::floor(value); }

/// Whole weights stay as they are; others become whole in units of 2⁻⁵⁰ of their sum, which changes it by
/// less than the 10⁻⁹ that a share may fall short.
double weight_scale(const std::vector<double>& weight) {
  double sum = 0;
  for (const double w : weight) sum += w;
  const double most = std::ldexp(1.0, 50);
  if (sum <= most && std::all_of(weight.begin(), weight.end(), is_whole)) return 1;
  return most / sum;
}

/// Groups that cost nothing to open, or have no columns, need not be thought of.
void drop_free_groups(CoverModel& model, const std::vector<double>& group_cost) {
  bool any = false;
  for (std::uint32_t& group : model.group) {
    if (group != kNoGroup && group_cost[group] == 0) group = kNoGroup;
    any = any || group != kNoGroup;
  }
  model.group_cost = any ? group_cost : std::vector<double>{};
}

}  // namespace

void NumberLists::add(std::span<const std::uint32_t> list) {
  entries_.insert(entries_.end(), list.begin(), list.end());
  start_.push_back(entries_.size());
}

NumberLists NumberLists::transposed(std::size_t count) const {
  NumberLists other;
  other.start_.assign(count + 1, 0);
  for (const std::uint32_t entry : entries_) ++other.start_[entry + 1];
  for (std::size_t i = 0; i < count; ++i) other.start_[i + 1] += other.start_[i];
  other.entries_.resize(entries_.size());
  std::vector<std::size_t> at(other.start_.begin(), other.start_.end() - 1);
  for (std::size_t list = 0; list < size(); ++list)
    for (const std::uint32_t entry : (*this)[list])
      other.entries_[at[entry]++] = static_cast<std::uint32_t>(list);
  return other;
}

CoverModel model_of(const SetCoverProblem& problem) {
  check(problem);
  std::vector<int> able(problem.rows, 0);
  for (const auto& column : problem.columns)
    for (const std::uint32_t row : column) ++able[row];

  CoverModel model;
  const double scale = weight_scale(problem.weight);
  std::vector<std::uint32_t> new_row(problem.rows, kNoGroup);
  for (std::size_t i = 0; i < problem.rows; ++i) {
    const double weight = problem.weight.empty() ? 1 : problem.weight[i];
    const int demand = std::min(able[i], problem.demand.empty() ? 1 : problem.demand[i]);
    if (weight == 0 || demand == 0) continue;
    new_row[i] = static_cast<std::uint32_t>(model.weight.size());
    model.weight.push_back(std::max<std::int64_t>(1, std::llround(weight * scale)));
    model.demand.push_back(demand);
    model.total += model.weight.back();
  }
  const double total = static_cast<double>(model.total);
  model.target = problem.share == 1
                     ? model.total
                     : static_cast<std::int64_t>(std::ceil(problem.share * total - 1e-9 * total));

  std::vector<std::uint32_t> rows;
  for (const auto& column : problem.columns) {
    rows.clear();
    for (const std::uint32_t row : column)
      if (new_row[row] != kNoGroup) rows.push_back(new_row[row]);
    model.rows_of.add(rows);
  }
  model.columns_of = model.rows_of.transposed(model.weight.size());
  model.cost = problem.cost.empty() ? std::vector<double>(problem.columns.size(), 1.0) : problem.cost;
  model.group =
      problem.group.empty() ? std::vector<std::uint32_t>(problem.columns.size(), kNoGroup) : problem.group;
  drop_free_groups(model, problem.group_cost);
  return model;
}

CoverModel part_of(const CoverModel& model, const std::vector<char>& keep_row,
                   const std::vector<char>& keep_column) {
  CoverModel part;
  std::vector<std::uint32_t> new_row(model.rows(), kNoGroup);
  for (std::size_t i = 0; i < model.rows(); ++i) {
    if (keep_row[i] == 0) continue;
    new_row[i] = static_cast<std::uint32_t>(part.weight.size());
    part.weight.push_back(model.weight[i]);
    part.demand.push_back(model.demand[i]);
    part.total += model.weight[i];
  }
  part.target = model.is_partial() ? model.target : part.total;
  std::vector<std::uint32_t> rows;
  for (std::size_t j = 0; j < model.columns(); ++j) {
    if (keep_column[j] == 0) continue;
    rows.clear();
    for (const std::uint32_t i : model.rows_of[j])
      if (keep_row[i] != 0) rows.push_back(new_row[i]);
    part.rows_of.add(rows);
    part.cost.push_back(model.cost[j]);
    part.group.push_back(model.group[j]);
  }
  part.columns_of = part.rows_of.transposed(part.weight.size());
  drop_free_groups(part, model.group_cost);
  return part;
}

double cost_of(const CoverModel& model, std::span<const std::uint32_t> chosen) {
  std::vector<char> open(model.group_cost.size(), 0);
  double cost = 0;
  for (const std::uint32_t j : chosen) {
    cost += model.cost[j];
    const std::uint32_t group = model.group[j];
    if (group == kNoGroup || open[group] != 0) continue;
    open[group] = 1;
    cost += model.group_cost[group];
  }
  return cost;
}

std::int64_t covered_weight(const CoverModel& model, std::span<const std::uint32_t> chosen) {
  std::vector<int> count(model.rows(), 0);
  std::int64_t weight = 0;
  for (const std::uint32_t j : chosen)
    for (const std::uint32_t i : model.rows_of[j])
      if (++count[i] == model.demand[i]) weight += model.weight[i];
  return weight;
}

double rounded_up(const CoverModel& model, double bound) {
  const bool whole = std::all_of(model.cost.begin(), model.cost.end(), is_whole) &&
                     std::all_of(model.group_cost.begin(), model.group_cost.end(), is_whole);
  // what solvers call a bound may lie a little above the true one
  return whole ? std::ceil(bound - 1e-6 * std::max(1.0, std::abs(bound))) : bound;
}

}  // namespace asterism
