// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"
#include "asterism/measurement/pose.hpp"
#include "asterism/measurement/reading.hpp"

namespace asterism {

struct TimeOffsetOptions {
  double max_offset_s = 0.5;       // the latency is searched for from minus this to plus this
  double largest_gap_s = 0.2;      // between tracker's poses, for the pose between them to be told
  double correlation_s = 0;        // for which the `correlated` share of the readings' noise keeps its value
  double gate_probability = 1e-3;  // of refusing a reading that fits
};
void describe(TimeOffsetOptions& options, OptionVisitor& visit);

/// How a platform's read-out and the tracker hang together, from a run that both saw.
struct TimeOffset {
  double latency_s = 0;  // a reading stamped s tells of where the body was at s − latency_s
  double sigma_s = 0;
  RigidMotion tracker_from_base;   // into the tracker's frame as the tracker measures it, its systematic
  Mat6 covariance = Mat6::Zero();  // error included: what of a pose's covariance is systematic is left out
  int readings = 0;                // that took part
  int refused = 0;                 // that fitted nothing: jumps
  double misfit = 0;               // χ² over its degrees of freedom; 1 when the stated covariances hold
};

enum class OffsetFailure { TooFew, NotMoving, BeyondSearch, Periodic };
/// The reason in words for a user.
[[nodiscard]] std::string_view text_of(OffsetFailure reason);

/// The latency τ and A = tracker_from_base that bring readings B_k and tracked poses X(t) together:
///
///   minimise Σ r_kᵀ W_k r_k,   r_k = A B_k ⊖ X(s_k − τ),   ∂r/∂τ = the body's velocity (tracker's axes)
///
/// X(t) is the cubic through the four poses about t, so the velocity has the tracker's noise alone: were it
/// the readings' own, their noise would look like motion. Gauss–Newton from the best τ of a grid (least
/// median of squares); readings beyond the gate are refused.
///
/// σ by N⁻¹ M N⁻¹, N = Σ Jᵀ W J and M the covariance of Σ Jᵀ W r itself, in which each reading and each pose
/// (which several readings lean on) comes once and correlated noise with all its neighbours; times the misfit
/// where that is above 1. The platform does not move when what the velocity tells of τ is not well above what
/// noise alone would seem to tell.
[[nodiscard]] Result<TimeOffset, OffsetFailure> estimate_time_offset(
    std::span<const TimedPose> tracked, std::span<const PlatformReading> readings,
    const TimeOffsetOptions& options);

}  // namespace asterism
