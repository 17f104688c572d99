// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/measurement/pose_curve.hpp"
#include "asterism/measurement/reading.hpp"

namespace asterism {

/// What ties a platform's read-out to the tracker.
struct ReadOutLink {
  double latency_s = 0;
  RigidMotion tracker_from_base;
};

/// One reading against the pose the tracker tells of the same moment.
struct ReadOutResidual {
  std::size_t reading;
  PoseBetween between;
  Vec6 residual;  // A B ⊖ X, along the tracker's axes
  Mat6 weight;    // inverse of its covariance
  double square;  // residualᵀ weight residual: χ² with six degrees
};
/// Of those readings that lie between tracked poses.
[[nodiscard]] std::vector<ReadOutResidual> residuals_of(const PoseCurve& curve,
                                                        std::span<const PlatformReading> readings,
                                                        const ReadOutLink& link, double largest_gap_s);

/// ∂ residual / ∂ (ω, δ of tracker_from_base, latency).
using Mat67 = Eigen::Matrix<double, 6, 7>;
[[nodiscard]] Mat67 jacobian_of(const ReadOutResidual& residual, const PlatformReading& reading,
                                const ReadOutLink& link);

}  // namespace asterism
