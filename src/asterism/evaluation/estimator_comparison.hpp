// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "asterism/evaluation/disturbance_runs.hpp"

namespace asterism {

/// What one estimator makes of one layout in one quantity over the draws, beside its bound.
struct EstimatorErrors {
  double mean = 0, rms = 0, max = 0;
  double bound = 0;  // RMS by the Cramér–Rao bound of the same moments
  [[nodiscard]] double over_bound() const { return rms / bound; }
};

/// One line of the table: estimator × layout.
struct EstimatorRow {
  std::string layout;
  Estimator estimator = Estimator::MaximumLikelihood;
  std::array<EstimatorErrors, kRunQuantities> errors;  // by RunQuantity; the worst point is one point here:
  std::string worst_point;                             // where the bound of this layout is largest
  std::size_t poses = 0, failed = 0;
};

struct EstimatorDraws {
  std::size_t runs = 2000;  // each at every moment of the trial
  std::uint64_t seed = 1;
};

/// How each way to make a pose does on each layout, from centres with noise alone: rig and targets are known
/// exactly, as the bound takes them. Moments that are not determined are left out for all estimators.
/// `noise` as the trials were made with.
[[nodiscard]] std::vector<EstimatorRow> compare_estimators(const Cell& cell,
                                                           std::span<const LayoutTrial> trials,
                                                           std::span<const Estimator> estimators,
                                                           const AccuracyOptions& noise,
                                                           const EstimatorDraws& draws);

}  // namespace asterism
