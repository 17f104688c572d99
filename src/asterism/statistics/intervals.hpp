// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "asterism/statistics/summary.hpp"

namespace asterism {

struct Interval {
  double low = 0, high = 0;
  [[nodiscard]] bool holds(double value) const { return low <= value && value <= high; }
  [[nodiscard]] double centre() const { return (low + high) / 2; }
  [[nodiscard]] double width() const { return high - low; }
};

/// Student's interval of the mean of independent normal values.
[[nodiscard]] Interval mean_interval(const Summary& sample, double confidence = 0.95);

/// The sample that an interval of the mean tells of: its centre is the mean, its width the deviation.
[[nodiscard]] Summary sample_of_interval(const Interval& interval, std::size_t count,
                                         double confidence = 0.95);

/// In how wide a band the mean of `count` independent χ² variables with `degrees` of freedom each stays
/// with the given probability. For the mean NEES of honest poses: degrees = 6 (Bar-Shalom et al. 2001, 5.4).
[[nodiscard]] Interval chi_square_mean_band(std::size_t count, double degrees, double confidence = 0.95);

/// In how wide a band the ratio of a sample's deviation to the true one stays.
[[nodiscard]] Interval deviation_ratio_band(std::size_t count, double confidence = 0.95);

struct BootstrapOptions {
  double confidence = 0.95;
  int resamples = 10000;
  std::uint64_t seed = 1;
};

using Statistic = std::function<double(std::span<const double>)>;

/// Bias-corrected and accelerated bootstrap interval (Efron 1987) of any statistic of independent values.
/// Same bits for any number of threads. Needs at least three values; a statistic that does not vary
/// between resamples gives an interval of no width.
[[nodiscard]] Interval bootstrap_interval(std::span<const double> values, const Statistic& statistic,
                                          const BootstrapOptions& options = {});

}  // namespace asterism
