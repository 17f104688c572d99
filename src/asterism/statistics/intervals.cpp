// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kResampling = 0x626f6f74;  // the purpose of its random streams

/// Student's t of the interval's half-width over the standard error.
double coverage_factor(std::size_t count, double confidence) {
  require(count >= 2, "an interval of a mean needs two values or more");
  require(confidence > 0 && confidence < 1, "a confidence lies in (0, 1)");
  return student_quantile(0.5 + confidence / 2, static_cast<double>(count - 1));
}

/// How much the statistic's spread changes with its value, by leaving each value out (Efron 1987, 6.6).
double acceleration(std::span<const double> values, const Statistic& statistic) {
  std::vector<double> without(values.size());
  parallel_for(values.size(), [&](std::size_t left_out) {
    std::vector<double> rest(values.begin(), values.end());
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
    without[left_out] = statistic(rest);
  });
  const double mean = mean_of(without);
  double squares = 0, cubes = 0;
  for (const double value : without) {
    squares += (mean - value) * (mean - value);
    cubes += (mean - value) * (mean - value) * (mean - value);
  }
  return squares > 0 ? cubes / (6 * std::pow(squares, 1.5)) : 0.0;
}

}  // namespace

Interval mean_interval(const Summary& sample, double confidence) {
  const double half = coverage_factor(sample.count, confidence) * sample.standard_error();
  return {sample.mean - half, sample.mean + half};
}

Summary sample_of_interval(const Interval& interval, std::size_t count, double confidence) {
  const double factor = coverage_factor(count, confidence);
  Summary sample;
  sample.count = count;
  sample.mean = interval.centre();
  sample.deviation = interval.width() / 2 / factor * std::sqrt(static_cast<double>(count));
  sample.lowest = sample.highest = sample.mean;  // an interval does not tell them
  return sample;
}

Interval chi_square_mean_band(std::size_t count, double degrees, double confidence) {
  require(count > 0 && degrees > 0, "a band of χ² needs values and degrees of freedom");
  const double n = static_cast<double>(count);
  return {chi_square_quantile(0.5 - confidence / 2, n * degrees) / n,
          chi_square_quantile(0.5 + confidence / 2, n * degrees) / n};
}

Interval deviation_ratio_band(std::size_t count, double confidence) {
  require(count >= 2, "a standard deviation is of two values or more");
  const double degrees = static_cast<double>(count - 1);
  return {std::sqrt(chi_square_quantile(0.5 - confidence / 2, degrees) / degrees),
          std::sqrt(chi_square_quantile(0.5 + confidence / 2, degrees) / degrees)};
}

Interval bootstrap_interval(std::span<const double> values, const Statistic& statistic,
                            const BootstrapOptions& options) {
  require(values.size() >= 3, "a bootstrap needs three values or more");
  require(options.resamples >= 100, "a bootstrap needs a hundred resamples or more");
  std::vector<double> resampled(static_cast<std::size_t>(options.resamples));
  parallel_for(resampled.size(), [&](std::size_t i) {
    RandomStream random(options.seed, i, kResampling);
    std::vector<double> draw(values.size());
    for (double& value : draw) value = values[random.below(static_cast<std::uint32_t>(values.size()))];
    resampled[i] = statistic(draw);
  });
  std::sort(resampled.begin(), resampled.end());

  const double seen = statistic(values);
  const auto [first, last] = std::equal_range(resampled.begin(), resampled.end(), seen);
  const double below = static_cast<double>(first - resampled.begin()) + static_cast<double>(last - first) / 2;
  const double count = static_cast<double>(resampled.size());
  const double bias = normal_quantile(std::clamp(below / count, 0.5 / count, 1 - 0.5 / count));
  const double a = acceleration(values, statistic);
  const auto bound = [&](double p) {
    const double shifted = bias + normal_quantile(p);
    return quantile_of_sorted(resampled, normal_probability(bias + shifted / (1 - a * shifted)));
  };
  return {bound(0.5 - options.confidence / 2), bound(0.5 + options.confidence / 2)};
}

}  // namespace asterism
