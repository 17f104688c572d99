// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/measurement/reading.hpp"
#include "asterism/tracking/motion_model.hpp"

// One state for a body that the tracker sees and whose platform tells its own pose; the steps of
// fused_filter.hpp.

namespace asterism {

constexpr Eigen::Index kFusedStates = 25;
using Mat25 = Eigen::Matrix<double, kFusedStates, kFusedStates>;

/// The read-out as the filter knows it; what it learns is part of the state.
struct ReadOutModel {
  double latency_s = 0, latency_sigma_s = 0;
  double correlation_s = 0;  // of the readings' `correlated` noise
};

/// A reading B, stamped s, tells of the body's pose X one latency τ before:
///
///   X(s − τ) = A · exp(b + w) B      A = tracker_from_base, constant
///                                    b: Gauss–Markov, covariance `correlated`, time correlation_s
///                                    w: white, the rest of the reading's covariance
///
/// Errors in the order: pose 0–5 and twist 6–11 as in a MotionState, A 12–17, b 18–23 (along the base's
/// axes), τ 24. τ is not corrected here, only its doubt is carried along (Schmidt 1966): a filter that
/// estimates it takes the noise of its own twist for motion and grows sure of what it cannot know.
/// time_offset.hpp tells it.
struct FusedState {
  double time_s = 0;
  RigidMotion tracker_from_body;
  Vec6 twist = Vec6::Zero();
  std::optional<RigidMotion> tracker_from_base;  // empty: no reading yet
  Vec6 read_out_error = Vec6::Zero();            // b
  Mat6 correlated = Mat6::Zero();                // stated by the last reading; zero: no reading yet
  Mat25 covariance = Mat25::Zero();
};

/// The pose seen for the first time, or anew; what is known of the read-out stays.
[[nodiscard]] FusedState started(const FusedState& before, double time_s, const RigidMotion& measured,
                                 const Mat6& noise, const FilterOptions& motion);
[[nodiscard]] FusedState carried_to(const FusedState& state, double time_s, const FilterOptions& motion,
                                    double correlation_s);

struct Correction {
  FusedState state;
  double nis;  // innovationᵀ S⁻¹ innovation; χ² with six degrees
};
[[nodiscard]] Correction corrected_by_pose(const FusedState& state, const RigidMotion& measured,
                                           const Mat6& noise);
/// A reading of the state's time; A must be known.
[[nodiscard]] Correction corrected_by_reading(const FusedState& state, const PlatformReading& reading);

/// A from the pose and a reading of the same time, with what its error shares with theirs: nothing is learnt
/// of the pose, nothing is used twice.
[[nodiscard]] FusedState with_base_from(const FusedState& state, const PlatformReading& reading);
/// A as it is known beforehand, independent of all else.
[[nodiscard]] FusedState with_base(const FusedState& state, const RigidMotion& tracker_from_base,
                                   const Mat6& covariance);
[[nodiscard]] FusedState with_latency_doubt(const FusedState& state, double sigma_s);
[[nodiscard]] Mat6 covariance_of_base(const FusedState& state);
/// A forgotten: the read-out slipped.
[[nodiscard]] FusedState without_base(const FusedState& state);

}  // namespace asterism
