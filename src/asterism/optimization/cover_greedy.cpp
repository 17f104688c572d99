// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/cover_greedy.hpp"

#include <algorithm>
#include <numeric>
#include <queue>

namespace asterism {
namespace {

struct Offer {
  double gain_per_cost;
  std::uint32_t column;
  bool operator<(const Offer& other) const {
    return gain_per_cost != other.gain_per_cost ? gain_per_cost < other.gain_per_cost : column > other.column;
  }
};

/// What is chosen so far.
class Choice {
 public:
  Choice(const CoverModel& model, bool by_weight)
      : model_(model), by_weight_(by_weight), missing_(model.demand), open_(model.group_cost.size(), 0) {}

  [[nodiscard]] Offer offer(std::uint32_t column) const {
    double gain = 0;
    for (const std::uint32_t i : model_.rows_of[column])
      if (missing_[i] > 0) gain += by_weight_ ? static_cast<double>(model_.weight[i]) / model_.demand[i] : 1;
    return {gain / cost(column), column};
  }

  /// True when it opens its group.
  bool choose(std::uint32_t column) {
    for (const std::uint32_t i : model_.rows_of[column])
      if (--missing_[i] == 0) covered_ += model_.weight[i];
    const std::uint32_t group = model_.group[column];
    if (group == kNoGroup || open_[group] != 0) return false;
    open_[group] = 1;
    return true;
  }

  [[nodiscard]] std::int64_t covered() const { return covered_; }

 private:
  [[nodiscard]] double cost(std::uint32_t column) const {
    const std::uint32_t group = model_.group[column];
    const bool opens = group != kNoGroup && open_[group] == 0;
    return model_.cost[column] + (opens ? model_.group_cost[group] : 0);
  }

  const CoverModel& model_;
  bool by_weight_;
  std::vector<int> missing_;
  std::vector<char> open_;
  std::int64_t covered_ = 0;
};

std::vector<std::uint32_t> choose(const CoverModel& model, std::span<const std::uint32_t> columns,
                                  bool by_weight, std::int64_t until) {
  Choice choice(model, by_weight);
  std::priority_queue<Offer> offers;
  for (const std::uint32_t j : columns) offers.push(choice.offer(j));
  std::vector<char> taken(model.columns(), 0);
  std::vector<std::uint32_t> chosen;
  while (!offers.empty() && choice.covered() < until) {
    const std::uint32_t column = offers.top().column;
    offers.pop();
    if (taken[column] != 0) continue;
    const Offer now = choice.offer(column);
    if (now.gain_per_cost <= 0) continue;
    if (!offers.empty() && now < offers.top()) {
      offers.push(now);
      continue;
    }
    taken[column] = 1;
    chosen.push_back(column);
    if (!choice.choose(column)) continue;
    for (const std::uint32_t j : columns)  // the others of the group have become cheaper
      if (taken[j] == 0 && model.group[j] == model.group[column]) offers.push(choice.offer(j));
  }
  return chosen;
}

}  // namespace

std::vector<std::uint32_t> greedy_cover(const CoverModel& model) {
  std::vector<std::uint32_t> all(model.columns());
  std::iota(all.begin(), all.end(), 0);
  return choose(model, all, model.is_partial(), model.target);
}

std::vector<std::uint32_t> in_order_of_gain(const CoverModel& model, std::span<const std::uint32_t> columns) {
  return choose(model, columns, true, model.total + 1);
}

std::vector<std::uint32_t> without_needless(const CoverModel& model, std::span<const std::uint32_t> cover) {
  std::vector<int> count(model.rows(), 0);
  for (const std::uint32_t j : cover)
    for (const std::uint32_t i : model.rows_of[j]) ++count[i];
  std::int64_t covered = covered_weight(model, cover);

  std::vector<std::uint32_t> dearest_first(cover.begin(), cover.end());
  std::stable_sort(dearest_first.begin(), dearest_first.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return model.cost[a] > model.cost[b]; });
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t j : dearest_first) {
    std::int64_t lost = 0;
    for (const std::uint32_t i : model.rows_of[j])
      if (count[i] == model.demand[i]) lost += model.weight[i];
    if (covered - lost < model.target) {
      kept.push_back(j);
      continue;
    }
    covered -= lost;
    for (const std::uint32_t i : model.rows_of[j]) --count[i];
  }
  return kept;
}

}  // namespace asterism
