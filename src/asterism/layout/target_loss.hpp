// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

// What is left of layouts when each target may be lost (the paper's Section 3.3). Lengths in mm.

namespace asterism {

using Layout = std::vector<Vec3>;

/// What the cost of the targets that are left may mean; lower is better. The paper's text says
/// `MeanPairDistance`, its figures are `DistanceToOwnCentroid`.
enum class LayoutCost {
  DistanceToOwnCentroid,   // mean distance of those left to their own centroid
  DistanceToFullCentroid,  // mean distance of those left to the centroid of all, lost or not
  DistanceToOrigin,        // mean distance of those left to the origin of the body
  MeanPairDistance,
};

struct TargetLossModel {
  double loss_probability = 0.05;  // of each target, independent of the others
  double noise_mm = 0.1;           // standard deviation of each coordinate
  LayoutCost cost = LayoutCost::DistanceToOwnCentroid;
};

/// One draw of one layout. Coverage is the sum of the distances between those left; fewer than two cover
/// nothing, and none costs nothing.
struct LossDraw {
  double cost_mm = 0, coverage_mm = 0;
  bool on_front = false;  // no other layout of the same run costs no more and covers no less
};

/// Of one layout over all runs; deviations with n − 1.
struct LossFigures {
  double mean_cost_mm = 0, cost_deviation_mm = 0;
  double mean_coverage_mm = 0, coverage_deviation_mm = 0;
  double front_share = 0;  // of the runs in which it is on the front of all layouts
};

/// Draws[layout][run]. Run r of layout l draws from the stream (seed, r · layouts + l): same bits for any
/// number of threads. Layouts have at most 32 targets.
[[nodiscard]] std::vector<std::vector<LossDraw>> draw_target_loss(std::span<const Layout> layouts,
                                                                  const TargetLossModel& model,
                                                                  std::size_t runs, std::uint64_t seed);

[[nodiscard]] std::vector<LossFigures> figures_of(std::span<const std::vector<LossDraw>> draws);

struct LossExpectation {
  LossFigures expected;
  LossFigures standard_error;  // of each figure over `runs` draws
};

/// The same without drawing: all 2ⁿ sets of targets left, each with its probability. The noise, which moves
/// a mean by some σ² / distance only, is left out of the sets and added to the cost's deviation to first
/// order. At most 16 targets a layout.
[[nodiscard]] std::vector<LossExpectation> expect_target_loss(std::span<const Layout> layouts,
                                                              const TargetLossModel& model, std::size_t runs);

}  // namespace asterism
