// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/cover_bound.hpp"

#include <algorithm>
#include <numeric>

namespace asterism {
namespace {

/// The relaxed problem's value at given prices, and how much of each row's demand its solution misses.
class Relaxation {
 public:
  explicit Relaxation(const CoverModel& model)
      : model_(model), missed_(model.rows()), reduced_(model.columns()), by_price_(model.rows()) {}

  double operator()(const std::vector<double>& price) {
    double value = wanted_rows(price);
    for (std::size_t j = 0; j < model_.columns(); ++j) {
      double reduced = model_.cost[j];
      for (const std::uint32_t i : model_.rows_of[j]) reduced -= price[i];
      reduced_[j] = reduced;
    }
    std::vector<double> group_value = model_.group_cost;
    for (std::size_t j = 0; j < model_.columns(); ++j)
      if (reduced_[j] < 0 && model_.group[j] != kNoGroup) group_value[model_.group[j]] += reduced_[j];
    for (const double group : group_value) value += std::min(0.0, group);
    for (std::size_t j = 0; j < model_.columns(); ++j) {
      const std::uint32_t group = model_.group[j];
      if (reduced_[j] >= 0 || (group != kNoGroup && group_value[group] >= 0)) continue;
      if (group == kNoGroup) value += reduced_[j];
      for (const std::uint32_t i : model_.rows_of[j]) missed_[i] -= 1;
    }
    return value;
  }

  [[nodiscard]] const std::vector<double>& missed() const { return missed_; }

 private:
  /// The rows that are to be covered: all, or the cheapest for their weight up to the target.
  double wanted_rows(const std::vector<double>& price) {
    double value = 0;
    std::iota(by_price_.begin(), by_price_.end(), 0);
    if (model_.is_partial()) {
      const auto per_weight = [&](std::uint32_t i) {
        return model_.demand[i] * price[i] / static_cast<double>(model_.weight[i]);
      };
      std::stable_sort(by_price_.begin(), by_price_.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return per_weight(a) < per_weight(b); });
    }
    std::int64_t left = model_.target;
    for (const std::uint32_t i : by_price_) {
      const double part =
          static_cast<double>(std::min(left, model_.weight[i])) / static_cast<double>(model_.weight[i]);
      left -= std::min(left, model_.weight[i]);
      missed_[i] = model_.demand[i] * part;
      value += missed_[i] * price[i];
    }
    return value;
  }

  const CoverModel& model_;
  std::vector<double> missed_, reduced_;
  std::vector<std::uint32_t> by_price_;
};

/// No column is paid more than it costs.
std::vector<double> first_prices(const CoverModel& model) {
  std::vector<double> price(model.rows());
  for (std::size_t i = 0; i < model.rows(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t j : model.columns_of[i])
      least = std::min(least, model.cost[j] / static_cast<double>(model.rows_of[j].size()));
    price[i] = least;
  }
  return price;
}

}  // namespace

CoverPrices dual_bound(const CoverModel& model, double upper, int steps) {
  constexpr int kPatience = 40;       // steps without gain before they are made shorter
  constexpr double kShortest = 1e-3;  // of the full step
  constexpr double kInertia = 0.8;    // of the last direction that is kept: less zigzag
  CoverPrices best;
  if (model.target == 0) return best;
  Relaxation relaxation(model);
  std::vector<double> price = first_prices(model), direction(model.rows(), 0);
  double stride = 1;
  int since_gain = 0;
  for (int step = 0; step < steps && stride > kShortest; ++step) {
    const double value = relaxation(price);
    if (step == 0 || value > best.bound) {
      best = {price, std::max(value, 0.0)};
      since_gain = 0;
      if (rounded_up(model, best.bound) >= upper) break;
    }
    double square = 0;
    for (std::size_t i = 0; i < model.rows(); ++i) {
      direction[i] = kInertia * direction[i] + (1 - kInertia) * relaxation.missed()[i];
      if (direction[i] > 0 || price[i] > 0) square += direction[i] * direction[i];
    }
    if (++since_gain > kPatience || square == 0) {
      stride /= 2;
      since_gain = 0;
      price = best.price;
      std::fill(direction.begin(), direction.end(), 0.0);
      continue;
    }
    // aims a little above what can be reached, so that steps do not vanish beside it
    const double by = stride * std::max(0.0, 1.02 * upper - value) / square;
    for (std::size_t i = 0; i < model.rows(); ++i) price[i] = std::max(0.0, price[i] + by * direction[i]);
  }
  return best;
}

}  // namespace asterism
