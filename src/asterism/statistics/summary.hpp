// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asterism {

/// What a sample comes to, in the sample's own unit.
struct Summary {
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;  // standard deviation with n − 1
  double lowest = 0, highest = 0;
  [[nodiscard]] double standard_error() const;
};

/// Sum with the rounding of each step carried along (Neumaier 1974).
[[nodiscard]] double exact_sum(std::span<const double> values);

/// Of one value or more.
[[nodiscard]] double mean_of(std::span<const double> values);

/// Of two values or more. Two passes with the rounding of the mean put right (Chan, Golub & LeVeque 1983),
/// so that samples with many common leading digits lose none of those that differ.
[[nodiscard]] Summary summarize(std::span<const double> values);

/// The value below which the share `p` in [0, 1] of the sample lies: linear between the order statistics
/// (Hyndman & Fan's type 7, the default of R and numpy).
[[nodiscard]] double quantile_of(std::span<const double> values, double p);
/// The same for values that stand in ascending order already.
[[nodiscard]] double quantile_of_sorted(std::span<const double> ascending, double p);

/// Correlation of the sample with itself `lag` places on: intervals that take the values for independent
/// are too narrow when it is far from zero.
[[nodiscard]] double autocorrelation(std::span<const double> values, std::size_t lag = 1);

}  // namespace asterism
