// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/statistics/intervals.hpp"

// Uncertainty by drawing: JCGM 101:2008, and the check of the first-order law of propagation against it.

namespace asterism {

/// One value of the quantity of interest with all inputs drawn from `random`. Called from several threads.
using Trial = std::function<double(RandomStream& random)>;

struct MonteCarloOptions {
  double coverage = 0.95;      // of the interval
  int significant_digits = 2;  // of the standard uncertainty that must be stable (1 or 2)
  std::uint64_t seed = 1;
  int most_blocks = 1000;  // gives up there; a block is 10⁴ trials (more for a coverage above 0.99)
};

struct MonteCarlo {
  double estimate = 0;     // mean
  double uncertainty = 0;  // standard deviation
  Interval interval;       // probabilistically symmetric
  Interval shortest;       // shortest that covers as much
  double tolerance = 0;    // δ of JCGM 101, 7.9.2: half a unit of the last digit asked for
  std::size_t trials = 0;
  bool stable = false;  // false: `most_blocks` were drawn and the digits asked for still move
};

/// Adaptive procedure of JCGM 101, 7.9: blocks of trials until twice the standard deviation of the mean
/// of each result (estimate, uncertainty, both ends of the interval) is below δ. Trial k draws from the
/// stream (seed, k), so the bits are the same for any number of threads.
[[nodiscard]] MonteCarlo monte_carlo(const Trial& trial, const MonteCarloOptions& options = {});

/// δ: half a unit of the last of `digits` significant digits of a standard uncertainty.
[[nodiscard]] double numerical_tolerance(double uncertainty, int digits);

/// A quantity and its standard uncertainty by the first-order law (JCGM 100, 5.2.2).
struct FirstOrder {
  double estimate = 0;
  double uncertainty = 0;
};

using Model = std::function<double(std::span<const double>)>;

/// The sensitivities are central differences over a hundredth of each input's standard uncertainty.
[[nodiscard]] FirstOrder first_order(const Model& model, std::span<const double> inputs,
                                     const MatX& covariance);

/// JCGM 101, 8.1: does the first-order interval agree with the drawn one?
struct FirstOrderCheck {
  Interval interval;                 // estimate ± k u
  double low_gap = 0, high_gap = 0;  // to the ends of the drawn interval
  double tolerance = 0;
  bool valid = false;  // both gaps are within the tolerance
};

/// `digits`: how many significant digits of the uncertainty matter. The draws should have been made stable
/// to one digit more than are asked for here.
[[nodiscard]] FirstOrderCheck check_first_order(const FirstOrder& first, const MonteCarlo& drawn,
                                                double coverage = 0.95, int digits = 1);

}  // namespace asterism
