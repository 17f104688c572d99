// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/summary.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// A running sum and what its roundings lost.
struct CarefulSum {
  double sum = 0, lost = 0;
  void add(double value) {
    const double next = sum + value;
    lost += std::abs(sum) >= std::abs(value) ? (sum - next) + value : (value - next) + sum;
    sum = next;
  }
  [[nodiscard]] double value() const { return sum + lost; }
};

}  // namespace

double Summary::standard_error() const { return deviation / std::sqrt(static_cast<double>(count)); }

double exact_sum(std::span<const double> values) {
  CarefulSum sum;
  for (const double value : values) sum.add(value);
  return sum.value();
}

double mean_of(std::span<const double> values) {
  require(!values.empty(), "a mean is of one value or more");
  return exact_sum(values) / static_cast<double>(values.size());
}

Summary summarize(std::span<const double> values) {
  require(values.size() >= 2, "a standard deviation is of two values or more");
  const double n = static_cast<double>(values.size());
  const double rough_mean = mean_of(values);
  CarefulSum squares, rest;
  for (const double value : values) {
    const double from_mean = value - rough_mean;
    squares.add(from_mean * from_mean);
    rest.add(from_mean);
  }
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  Summary summary;
  summary.count = values.size();
  summary.mean = rough_mean + rest.value() / n;
  summary.deviation = std::sqrt(std::max(0.0, squares.value() - rest.value() * rest.value() / n) / (n - 1));
  summary.lowest = *lowest;
  summary.highest = *highest;
  return summary;
}

double quantile_of_sorted(std::span<const double> ascending, double p) {
  require(!ascending.empty(), "a quantile is of one value or more");
  require(p >= 0 && p <= 1, "a quantile's share lies in [0, 1]");
  const double place = p * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return ascending[below] + (place - static_cast<double>(below)) * (ascending[above] - ascending[below]);
}

double quantile_of(std::span<const double> values, double p) {
  std::vector<double> ascending(values.begin(), values.end());
  std::sort(ascending.begin(), ascending.end());
  return quantile_of_sorted(ascending, p);
}

double autocorrelation(std::span<const double> values, std::size_t lag) {
  require(values.size() > lag + 1, "an autocorrelation needs more values than its lag");
  const double mean = summarize(values).mean;
  CarefulSum products, squares;
  for (std::size_t i = 0; i < values.size(); ++i) {
    squares.add((values[i] - mean) * (values[i] - mean));
    if (i + lag < values.size()) products.add((values[i] - mean) * (values[i + lag] - mean));
  }
  return squares.value() > 0 ? products.value() / squares.value() : 0.0;
}

}  // namespace asterism
