// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/monte_carlo.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kTrials = 0x6a636731;  // the purpose of its random streams
constexpr std::size_t kTogether = 500;         // trials a piece of a parallel loop

/// JCGM 101, 7.9.4 b.
std::size_t block_size(double coverage) {
  return std::max<std::size_t>(10000, static_cast<std::size_t>(std::ceil(100 / (1 - coverage))));
}

std::vector<double> draw_block(const Trial& trial, std::uint64_t seed, std::size_t first, std::size_t count) {
  std::vector<double> values(count);
  parallel_for((count + kTogether - 1) / kTogether, [&](std::size_t piece) {
    const std::size_t end = std::min(count, (piece + 1) * kTogether);
    for (std::size_t i = piece * kTogether; i < end; ++i) {
      RandomStream random(seed, first + i, kTrials);
      values[i] = trial(random);
    }
  });
  for (const double value : values) require(std::isfinite(value), "a trial gives a finite value");
  return values;
}

/// JCGM 101, 7.7.2: between the order statistics that leave as much below as above.
Interval symmetric_interval(std::span<const double> ascending, double coverage) {
  return {quantile_of_sorted(ascending, 0.5 - coverage / 2),
          quantile_of_sorted(ascending, 0.5 + coverage / 2)};
}

/// JCGM 101, 7.7.4.
Interval shortest_interval(std::span<const double> ascending, double coverage) {
  const auto held = static_cast<std::size_t>(std::round(coverage * static_cast<double>(ascending.size())));
  Interval best{ascending.front(), ascending.back()};
  for (std::size_t i = 0; i + held < ascending.size(); ++i) {
    const Interval here{ascending[i], ascending[i + held]};
    if (here.width() < best.width()) best = here;
  }
  return best;
}

/// What each block came to.
struct Blocks {
  std::vector<double> estimate, uncertainty, low, high;

  void add(std::vector<double> values, double coverage) {
    std::sort(values.begin(), values.end());
    const Summary summary = summarize(values);
    const Interval interval = symmetric_interval(values, coverage);
    estimate.push_back(summary.mean);
    uncertainty.push_back(summary.deviation);
    low.push_back(interval.low);
    high.push_back(interval.high);
  }

  [[nodiscard]] bool within(double tolerance) const {
    for (const auto* results : {&estimate, &uncertainty, &low, &high}) {
      if (2 * summarize(*results).standard_error() > tolerance) return false;
    }
    return true;
  }
};

}  // namespace

double numerical_tolerance(double uncertainty, int digits) {
  require(uncertainty >= 0 && digits >= 1, "an uncertainty is not negative and has a digit or more");
  if (uncertainty == 0) return 0;
  // u = c · 10^l with an integer c of `digits` digits: 0.0996 to two digits is 10 · 10⁻², not 100 · 10⁻³.
  int exponent = static_cast<int>(std::floor(std::log10(uncertainty))) - digits + 1;
  if (std::round(uncertainty / std::pow(10.0, exponent)) >= std::pow(10.0, digits)) ++exponent;
  return 0.5 * std::pow(10.0, exponent);
}

MonteCarlo monte_carlo(const Trial& trial, const MonteCarloOptions& options) {
  require(options.coverage > 0 && options.coverage < 1, "a coverage lies in (0, 1)");
  require(options.most_blocks >= 2, "a Monte Carlo takes two blocks or more");
  const std::size_t per_block = block_size(options.coverage);
  std::vector<double> all;
  Blocks blocks;
  MonteCarlo result;
  for (int block = 0; block < options.most_blocks && !result.stable; ++block) {
    std::vector<double> values = draw_block(trial, options.seed, all.size(), per_block);
    all.insert(all.end(), values.begin(), values.end());
    blocks.add(std::move(values), options.coverage);
    if (block == 0) continue;
    const Summary summary = summarize(all);
    result.estimate = summary.mean;
    result.uncertainty = summary.deviation;
    result.tolerance = numerical_tolerance(summary.deviation, options.significant_digits);
    result.stable = blocks.within(result.tolerance);
  }
  result.trials = all.size();
  std::sort(all.begin(), all.end());
  result.interval = symmetric_interval(all, options.coverage);
  result.shortest = shortest_interval(all, options.coverage);
  return result;
}

FirstOrder first_order(const Model& model, std::span<const double> inputs, const MatX& covariance) {
  const auto n = static_cast<Eigen::Index>(inputs.size());
  require(covariance.rows() == n && covariance.cols() == n, "a covariance has a row and column an input");
  std::vector<double> at(inputs.begin(), inputs.end());
  VecX sensitivity = VecX::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double step = 0.01 * std::sqrt(covariance(i, i));
    if (!(step > 0)) continue;
    double& input = at[static_cast<std::size_t>(i)];
    const double centre = input;
    input = centre + step;
    const double above = model(at);
    input = centre - step;
    const double below = model(at);
    input = centre;
    sensitivity(i) = (above - below) / (2 * step);
  }
  const double variance = sensitivity.dot(covariance * sensitivity);
  return {model(at), std::sqrt(std::max(0.0, variance))};
}

FirstOrderCheck check_first_order(const FirstOrder& first, const MonteCarlo& drawn, double coverage,
                                  int digits) {
  const double half = normal_quantile(0.5 + coverage / 2) * first.uncertainty;
  FirstOrderCheck check;
  check.interval = {first.estimate - half, first.estimate + half};
  check.low_gap = std::abs(check.interval.low - drawn.interval.low);
  check.high_gap = std::abs(check.interval.high - drawn.interval.high);
  check.tolerance = numerical_tolerance(first.uncertainty, digits);
  check.valid = check.low_gap <= check.tolerance && check.high_gap <= check.tolerance;
  return check;
}

}  // namespace asterism
