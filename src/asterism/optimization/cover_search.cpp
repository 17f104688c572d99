// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/cover_search.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/optimization/cover_greedy.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kPurpose = 0x5e7c0;  // of the random numbers

/// Numbers that are in a set, to be gone through, added and taken out at once.
class NumberSet {
 public:
  explicit NumberSet(std::size_t count) : place_(count, kNowhere) {}
  void add(std::uint32_t number) {
    place_[number] = static_cast<std::uint32_t>(numbers_.size());
    numbers_.push_back(number);
  }
  void remove(std::uint32_t number) {
    const std::uint32_t last = numbers_.back();
    numbers_[place_[number]] = last;
    place_[last] = place_[number];
    place_[number] = kNowhere;
    numbers_.pop_back();
  }
  [[nodiscard]] bool has(std::uint32_t number) const { return place_[number] != kNowhere; }
  [[nodiscard]] const std::vector<std::uint32_t>& numbers() const { return numbers_; }

 private:
  static constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> numbers_, place_;
};

class RowWeighting {
 public:
  RowWeighting(const CoverModel& model, std::span<const std::uint32_t> start, RandomStream random)
      : model_(model),
        random_(random),
        chosen_(model.columns()),
        short_(model.rows()),
        score_(model.columns(), 0),
        heaviness_(model.rows(), 1),
        count_(model.rows(), 0),
        column_changed_(model.columns(), 0),
        row_changed_(model.rows(), 1),
        open_(model.group_cost.size(), 0),
        all_cost_alike_(!model.has_groups() && std::all_of(model.cost.begin(), model.cost.end(),
                                                           [&](double c) { return c == model.cost[0]; })),
        short_weight_(model.total),
        best_(start.begin(), start.end()),
        best_cost_(cost_of(model, start)) {
    for (std::uint32_t i = 0; i < model.rows(); ++i) {
      short_.add(i);
      for (const std::uint32_t j : model.columns_of[i]) score_[j] += heaviness_[i];
    }
    for (const std::uint32_t j : start) put_in(j);
  }

  void step() {
    if (is_cover()) just_put_in_.clear();
    while (is_cover()) {
      keep_best();
      take_out(least_missed());
    }
    const std::uint32_t out = least_missed();
    if (out != kNoGroup) take_out(out);
    just_put_in_.clear();
    while (!is_cover()) {
      const auto& rows = short_.numbers();
      const std::uint32_t in = best_for(rows[random_.below(static_cast<std::uint32_t>(rows.size()))]);
      if (in == kNoGroup) break;
      put_in(in);
      just_put_in_.push_back(in);
    }
    if (is_cover()) return;
    if (!model_.is_partial()) {
      for (const std::uint32_t i : short_.numbers()) make_heavier(i);
      return;
    }
    const auto& rows = short_.numbers();  // most may stay short: one at random is enough
    make_heavier(rows[random_.below(static_cast<std::uint32_t>(rows.size()))]);
  }

  [[nodiscard]] const std::vector<std::uint32_t>& best() const { return best_; }
  [[nodiscard]] double best_cost() const { return best_cost_; }

 private:
  [[nodiscard]] bool is_cover() const { return short_weight_ <= model_.total - model_.target; }

  void make_heavier(std::uint32_t row) {
    heaviness_[row] += 1;
    for (const std::uint32_t j : model_.columns_of[row]) score_[j] += 1;
  }

  void keep_best() {
    const double cost = cost_of(model_, chosen_.numbers());
    if (cost >= best_cost_) return;
    best_ = chosen_.numbers();
    best_cost_ = cost;
  }

  /// What the column costs beyond the others that are chosen.
  [[nodiscard]] double cost(std::uint32_t column) const {
    if (all_cost_alike_) return model_.cost[0];
    const std::uint32_t group = model_.group[column];
    if (group == kNoGroup) return model_.cost[column];
    const int others = open_[group] - (chosen_.has(column) ? 1 : 0);
    return model_.cost[column] + (others == 0 ? model_.group_cost[group] : 0);
  }

  /// Of the chosen ones, the column whose rows weigh least for its cost; the one that is longest in.
  [[nodiscard]] std::uint32_t least_missed() const {
    std::uint32_t least = kNoGroup;
    double least_score = 0, least_cost = 1;
    for (const std::uint32_t j : chosen_.numbers()) {
      const double its_score = static_cast<double>(score_[j]), its_cost = cost(j);
      const double left = its_score * least_cost, right = least_score * its_cost;
      if (least != kNoGroup &&
          (left > right || (left == right && column_changed_[j] >= column_changed_[least])))
        continue;
      if (std::find(just_put_in_.begin(), just_put_in_.end(), j) != just_put_in_.end()) continue;
      least = j;
      least_score = its_score;
      least_cost = its_cost;
    }
    return least;
  }

  [[nodiscard]] bool may_come_back(std::uint32_t column) const {
    const auto rows = model_.rows_of[column];
    return std::any_of(rows.begin(), rows.end(),
                       [&](std::uint32_t i) { return row_changed_[i] > column_changed_[column]; });
  }

  [[nodiscard]] std::uint32_t best_for(std::uint32_t row) const {
    std::uint32_t best = kNoGroup;
    double best_score = 0, best_column_cost = 1;
    for (const std::uint32_t j : model_.columns_of[row]) {
      if (chosen_.has(j)) continue;
      const double its_score = static_cast<double>(score_[j]), its_cost = cost(j);
      const double left = its_score * best_column_cost, right = best_score * its_cost;
      if (left < right || (left == right && best != kNoGroup && column_changed_[j] >= column_changed_[best]))
        continue;
      if (cost_ + its_cost >= best_cost_ - 1e-9 || !may_come_back(j)) continue;
      best = j;
      best_score = its_score;
      best_column_cost = its_cost;
    }
    return best;
  }
  void put_in(std::uint32_t column) {
    cost_ += cost(column);
    ++time_;
    for (const std::uint32_t i : model_.rows_of[column]) {
      row_changed_[i] = time_;
      const int before = count_[i]++;
      if (before == model_.demand[i]) {
        for (const std::uint32_t j : model_.columns_of[i])
          if (chosen_.has(j)) score_[j] -= heaviness_[i];
      } else if (before + 1 == model_.demand[i]) {
        for (const std::uint32_t j : model_.columns_of[i])
          if (!chosen_.has(j) && j != column) score_[j] -= heaviness_[i];
        short_.remove(i);
        short_weight_ -= model_.weight[i];
      }
    }
    chosen_.add(column);
    column_changed_[column] = time_;
    if (model_.group[column] != kNoGroup) ++open_[model_.group[column]];
  }

  void take_out(std::uint32_t column) {
    cost_ -= cost(column);
    ++time_;
    chosen_.remove(column);
    for (const std::uint32_t i : model_.rows_of[column]) {
      row_changed_[i] = time_;
      const int before = count_[i]--;
      if (before == model_.demand[i] + 1) {
        for (const std::uint32_t j : model_.columns_of[i])
          if (chosen_.has(j)) score_[j] += heaviness_[i];
      } else if (before == model_.demand[i]) {
        for (const std::uint32_t j : model_.columns_of[i])
          if (!chosen_.has(j) && j != column) score_[j] += heaviness_[i];
        short_.add(i);
        short_weight_ += model_.weight[i];
      }
    }
    column_changed_[column] = time_;
    if (model_.group[column] != kNoGroup) --open_[model_.group[column]];
  }

  const CoverModel& model_;
  RandomStream random_;
  NumberSet chosen_, short_;
  std::vector<std::int64_t> score_;      // by column: what its rows weigh that would change
  std::vector<std::int64_t> heaviness_;  // by row
  std::vector<int> count_;               // by row
  std::vector<std::int64_t> column_changed_, row_changed_;
  std::vector<int> open_;  // by group: chosen columns
  bool all_cost_alike_;
  std::int64_t time_ = 1;
  std::int64_t short_weight_;
  double cost_ = 0;
  std::vector<std::uint32_t> just_put_in_;
  std::vector<std::uint32_t> best_;
  double best_cost_;
};

std::vector<std::uint32_t> search(const CoverModel& model, std::span<const std::uint32_t> start, int steps,
                                  double bound, RandomStream random, const Progress& progress) {
  RowWeighting weighting(model, start, random);
  constexpr int kTell = 1000;
  for (int step = 0; step < steps && weighting.best_cost() > bound; ++step) {
    if (step % kTell == 0)
      progress("searching a cheaper cover", static_cast<std::size_t>(step), static_cast<std::size_t>(steps));
    weighting.step();
  }
  return weighting.best();
}

/// Several at once, each with random numbers of its own; the first of the best.
std::vector<std::uint32_t> best_search(const CoverModel& model, std::span<const std::uint32_t> start,
                                       int steps, double bound, std::uint64_t seed, std::uint32_t purpose,
                                       const Progress& progress) {
  constexpr std::size_t kSearches = 2;
  std::array<std::vector<std::uint32_t>, kSearches> found;
  parallel_for(kSearches, [&](std::size_t k) {
    found[k] = search(model, start, steps, bound, RandomStream(seed, k, purpose),
                      k == 0 ? progress : Progress(no_progress));
  });
  return *std::min_element(found.begin(), found.end(), [&](const auto& a, const auto& b) {
    return cost_of(model, a) < cost_of(model, b);
  });
}

/// A good cover that leaves the group closed; none if there is none.
std::vector<std::uint32_t> cover_without_group(const CoverModel& model, std::uint32_t group, int steps,
                                               double bound, std::uint64_t seed, const Progress& progress) {
  std::vector<std::uint32_t> column;
  std::vector<char> keep(model.columns(), 0);
  for (std::uint32_t j = 0; j < model.columns(); ++j) {
    if (model.group[j] == group) continue;
    keep[j] = 1;
    column.push_back(j);
  }
  if (covered_weight(model, column) < model.target) return {};
  const CoverModel part = part_of(model, std::vector<char>(model.rows(), 1), keep);
  const auto start = without_needless(part, greedy_cover(part));
  auto cover = best_search(part, start, steps, bound, seed, kPurpose + 1 + group, progress);
  for (std::uint32_t& j : cover) j = column[j];
  return cover;
}

std::vector<std::uint32_t> open_groups(const CoverModel& model, std::span<const std::uint32_t> cover) {
  std::vector<std::uint32_t> groups;
  for (const std::uint32_t j : cover)
    if (model.group[j] != kNoGroup) groups.push_back(model.group[j]);
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return groups;
}

}  // namespace

std::vector<std::uint32_t> searched_cover(const CoverModel& model, std::span<const std::uint32_t> start,
                                          int steps, double bound, std::uint64_t seed,
                                          const Progress& progress) {
  if (start.empty()) return {};
  auto best = best_search(model, start, steps, bound, seed, kPurpose, progress);
  bool closed = model.has_groups();
  while (closed) {  // single steps seldom empty a group
    closed = false;
    for (const std::uint32_t group : open_groups(model, best)) {
      auto without = cover_without_group(model, group, steps / 10, bound, seed, progress);
      if (without.empty() || cost_of(model, without) >= cost_of(model, best)) continue;
      best = std::move(without);
      closed = true;
      break;
    }
  }
  return best;
}

}  // namespace asterism
