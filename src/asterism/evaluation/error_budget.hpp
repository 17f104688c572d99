// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "asterism/evaluation/pose_experiment.hpp"
#include "asterism/statistics/monte_carlo.hpp"

namespace asterism {

/// What one source of errors makes at a point.
struct BudgetShare {
  ErrorSource source;
  double sigma_mm = 0;          // √tr of its covariance there
  Vec3 bias_mm = Vec3::Zero();  // what it makes on average: latency times speed, growth
  double share = 0;             // of the mean square error; all shares sum to 1
};

/// Where the error at a point of the body comes from at one moment: first order (JCGM 100, 5.2.2), each
/// source by itself, by central differences through the estimator itself; then all sources at once by
/// drawing (JCGM 101), which tells whether first order was good enough (its clause 8).
struct ErrorBudget {
  std::vector<BudgetShare> shares;  // by source, in the order of ErrorSource
  Mat6 covariance = Mat6::Zero();   // of the pose, all sources
  Vec6 bias = Vec6::Zero();         // of the pose
  double rms_mm = 0;                // √(Σ σ² + |bias|²) at the point
  Vec3 widest = Vec3::UnitX();      // unit, along the tracker's axes: along it the error is checked
  FirstOrder first;                 // of the error along `widest`
  MonteCarlo drawn;                 // the same, drawn
  FirstOrderCheck check;
  MonteCarlo distance;     // |error| at the point, drawn; its interval is of 90 %, so that
  double below_95_mm = 0;  // its upper end is what |error| stays below with 95 % probability
};

struct BudgetOptions {
  std::uint64_t seed = 1;
  int most_blocks = 4;  // of 10⁴ draws
};

/// Throws MeasurementError when the pose at that moment cannot be estimated. Draws that give no pose are
/// drawn again.
[[nodiscard]] ErrorBudget error_budget(const PoseExperiment& experiment, const Vec3& in_body,
                                       const BudgetOptions& options);

/// The first-order part alone: shares, covariance, bias.
[[nodiscard]] ErrorBudget first_order_budget(const PoseExperiment& experiment, const Vec3& in_body);

}  // namespace asterism
