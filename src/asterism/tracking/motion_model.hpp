// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/core/options.hpp"
#include "asterism/measurement/pose.hpp"

// How a body moves between frames; shared by the filter and the smoother.

namespace asterism {

struct FilterOptions {
  double rate_wander_deg_s = 100;   // by how much the turning rate changes in one second (one sigma)
  double speed_wander_mm_s = 1000;  // the same of the speed
  double initial_rate_deg_s = 100;  // how fast a body may be turning when first seen
  double initial_speed_mm_s = 1000;
  double gate_probability = 1e-6;  // of refusing a pose that fits the motion
  double coast_max_s = 0.5;        // how long a body that is not seen is carried on
};
void describe(FilterOptions& options, OptionVisitor& visit);

using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

/// A pose with its twist: turning rate (rad/s) and velocity of the body's origin (mm/s), both along the
/// body's axes. With a constant twist the body moves on a screw, as a platform turning about any pivot does.
/// Covariance: the pose's error as in geometry/rigid_motion.hpp, then the twist's (additive).
struct MotionState {
  double time_s = 0;
  RigidMotion tracker_from_body;
  Vec6 twist = Vec6::Zero();
  Mat12 covariance = Mat12::Zero();
};

/// At rest within the options' initial rates, measured once.
[[nodiscard]] MotionState first_state(double time_s, const RigidMotion& measured, const Mat6& noise,
                                      const FilterOptions& options);

/// The constant twist that leads from one pose to another.
[[nodiscard]] Vec6 twist_between(const RigidMotion& from, const RigidMotion& to, double seconds);

struct Prediction {
  MotionState state;
  Mat12 transition;  // ∂ its error / ∂ the error before
};
/// R ← R exp(ω dt), t ← t + R V(ω dt) v dt; the twist wanders by white acceleration.
[[nodiscard]] Prediction predicted(const MotionState& state, double time_s, const FilterOptions& options);

/// A state carried on to a measurement's time and corrected by it.
struct Update {
  Prediction before;
  MotionState state;
  double nis;  // innovationᵀ S⁻¹ innovation; χ² with six degrees
};
/// `fresh`: the state is a first_state; its twist is then set to what the two poses tell before linearising,
/// for the product of an unknown rate and an unknown speed is not linear.
[[nodiscard]] Update updated(const MotionState& state, bool fresh, double time_s, const RigidMotion& measured,
                             const Mat6& noise, const FilterOptions& options);

/// By how much a prediction's covariance falls short of a pose that contradicts it: widened so far, its
/// distance from that pose is what six honest coordinates have on average. At least 1.
[[nodiscard]] double contradiction(const RigidMotion& predicted, const Mat6& covariance,
                                   const RigidMotion& measured);

/// The error that takes `from` to `to`, and the state moved by an error.
[[nodiscard]] Vec12 difference(const MotionState& to, const MotionState& from);
[[nodiscard]] MotionState moved(const MotionState& state, const Vec12& error);

}  // namespace asterism
