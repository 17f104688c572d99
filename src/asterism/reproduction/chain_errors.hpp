// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asterism/evaluation/estimator_comparison.hpp"
#include "asterism/reproduction/disturbance.hpp"

// Tables 13 and 14 and Figures 21 to 24 by the program's own rooms on the cell of chain_cell.hpp: the exact
// image of each disc disturbed by 0.20 px, then least squares as the paper does or asterism's own estimator.

namespace asterism {

/// Pixel noise that gives Table 13 with the paper's own estimator.
constexpr double kChainSigmaPx = 0.20;

/// What an experiment of 50 poses at rest gives by scheme of Table 1.
[[nodiscard]] std::vector<ExpectedErrors> expect_chain_errors(Estimator estimator, std::size_t experiments,
                                                              std::uint64_t seed);

/// One such experiment of each scheme under common random numbers: errors in the order of runs.
[[nodiscard]] std::vector<PoseErrorSample> chain_sample(Estimator estimator, std::size_t runs,
                                                        std::uint64_t seed);

/// The platform's errors in the frames of the motion, with targets (S1 of Table 1, simulated centres through
/// the whole tracker) and by its own read-out under the error model of cell/platform.hpp.
struct ChainTrace {
  std::vector<double> times_s;
  std::vector<double> with_deg, with_mm;  // frames without a pose are left out of both and counted
  std::vector<double> with_times_s;
  std::size_t without_pose = 0;
  std::vector<double> read_out_deg, read_out_mm;
};
[[nodiscard]] ChainTrace chain_trace(std::uint64_t seed);

}  // namespace asterism
