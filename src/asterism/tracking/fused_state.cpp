// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/fused_state.hpp"

#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

constexpr Eigen::Index kBase = 12, kReadOut = 18, kLatency = 24;
using Mat6x25 = Eigen::Matrix<double, 6, kFusedStates>;
using Mat25x6 = Eigen::Matrix<double, kFusedStates, 6>;

MotionState motion_of(const FusedState& state) {
  return {state.time_s, state.tracker_from_body, state.twist, Mat12::Zero()};
}

Mat6 turn_of(const RigidMotion& a_from_b) {
  Mat6 turn = Mat6::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = a_from_b.rotation.toRotationMatrix();
  return turn;
}

/// A reading without what is known of its error.
RigidMotion freed(const PlatformReading& reading, const FusedState& state) {
  return perturbed(reading.base_from_body, state.read_out_error);
}

/// What the errors of pose, read-out and latency make of the pose that a reading tells of, less the reading.
Mat6x25 told_less_read(const FusedState& state, const Mat6& turn) {
  const Mat3 body = state.tracker_from_body.rotation.toRotationMatrix();
  Mat6x25 h = Mat6x25::Zero();
  h.leftCols<6>().setIdentity();
  h.middleCols<6>(kReadOut) = -turn;
  h.col(kLatency) << -body * state.twist.head<3>(), -body * state.twist.tail<3>();
  return h;
}

FusedState moved(const FusedState& state, const Eigen::Matrix<double, kFusedStates, 1>& error) {
  FusedState next = state;
  next.tracker_from_body = perturbed(state.tracker_from_body, error.head<6>());
  next.twist += error.segment<6>(6);
  if (state.tracker_from_base) {
    next.tracker_from_base = perturbed(*state.tracker_from_base, error.segment<6>(kBase));
  }
  next.read_out_error += error.segment<6>(kReadOut);
  return next;
}

Correction corrected(const FusedState& state, const Mat6x25& h, const Vec6& innovation, const Mat6& noise) {
  const Mat25x6 cross = state.covariance * h.transpose();
  const auto inverse = inverse_positive(Mat6(h * cross + noise));
  require(inverse.has_value(), "a measurement's covariance is positive definite");
  Mat25x6 gain = cross * *inverse;
  gain.row(kLatency).setZero();
  Correction correction{moved(state, gain * innovation), innovation.dot(*inverse * innovation)};
  // Joseph's form holds for any gain.
  const Mat25 keep = Mat25::Identity() - gain * h;
  correction.state.covariance = keep * state.covariance * keep.transpose() + gain * noise * gain.transpose();
  return correction;
}

void take_over_noise(FusedState& state, const PlatformReading& reading) {
  if (state.correlated.isZero(0)) state.covariance.block<6, 6>(kReadOut, kReadOut) = reading.correlated;
  state.correlated = reading.correlated;
}

}  // namespace

FusedState started(const FusedState& before, double time_s, const RigidMotion& measured, const Mat6& noise,
                   const FilterOptions& motion) {
  const MotionState first = first_state(time_s, measured, noise, motion);
  FusedState state = before;
  state.time_s = time_s;
  state.tracker_from_body = measured;
  state.twist = first.twist;
  state.covariance.topRows<12>().setZero();
  state.covariance.leftCols<12>().setZero();
  state.covariance.topLeftCorner<12, 12>() = first.covariance;
  return state;
}

FusedState carried_to(const FusedState& state, double time_s, const FilterOptions& motion,
                      double correlation_s) {
  const Prediction prediction = predicted(motion_of(state), time_s, motion);
  const double keeps = correlation_s > 0 ? std::exp(-(time_s - state.time_s) / correlation_s) : 0.0;
  FusedState next = state;
  next.time_s = time_s;
  next.tracker_from_body = prediction.state.tracker_from_body;
  next.read_out_error *= keeps;
  Mat25 f = Mat25::Identity();
  f.topLeftCorner<12, 12>() = prediction.transition;
  f.diagonal().segment<6>(kReadOut).setConstant(keeps);
  next.covariance = f * state.covariance * f.transpose();
  next.covariance.topLeftCorner<12, 12>() += prediction.state.covariance;  // of the wandering alone
  next.covariance.block<6, 6>(kReadOut, kReadOut) += (1 - keeps * keeps) * state.correlated;
  return next;
}

Correction corrected_by_pose(const FusedState& state, const RigidMotion& measured, const Mat6& noise) {
  Mat6x25 h = Mat6x25::Zero();
  h.leftCols<6>().setIdentity();
  return corrected(state, h, difference(measured, state.tracker_from_body), noise);
}

Correction corrected_by_reading(const FusedState& state, const PlatformReading& reading) {
  FusedState before = state;
  take_over_noise(before, reading);
  const RigidMotion& base = before.tracker_from_base.value();
  const RigidMotion told = freed(reading, before);
  const Mat6 turn = turn_of(base);
  Mat6x25 h = told_less_read(before, turn);
  h.middleCols<6>(kBase).setIdentity();
  h.block<3, 3>(3, kBase) = -skew(base.rotation * told.translation);
  h.middleCols<6>(kBase) *= -1;
  const Mat6 white = turn * (reading.covariance - reading.correlated) * turn.transpose();
  return corrected(before, h, difference(base * told, before.tracker_from_body), white);
}

FusedState with_base_from(const FusedState& state, const PlatformReading& reading) {
  FusedState next = without_base(state);
  take_over_noise(next, reading);
  const RigidMotion told = freed(reading, next);
  const RigidMotion base = next.tracker_from_body * told.inverse();
  const Mat6 turn = turn_of(base);
  Mat6 by_pose = Mat6::Identity();  // the base's error from the error of where the body is
  by_pose.bottomLeftCorner<3, 3>() = skew(base.rotation * told.translation);
  const Mat6x25 g = by_pose * told_less_read(next, turn);
  const Mat6 white = turn * (reading.covariance - reading.correlated) * turn.transpose();
  Mat25 f = Mat25::Identity();
  f.middleRows<6>(kBase) = g;
  next.covariance = f * next.covariance * f.transpose();
  next.covariance.block<6, 6>(kBase, kBase) += by_pose * white * by_pose.transpose();
  next.tracker_from_base = base;
  return next;
}

FusedState with_base(const FusedState& state, const RigidMotion& tracker_from_base, const Mat6& covariance) {
  FusedState next = without_base(state);
  next.tracker_from_base = tracker_from_base;
  next.covariance.block<6, 6>(kBase, kBase) = covariance;
  return next;
}

FusedState with_latency_doubt(const FusedState& state, double sigma_s) {
  FusedState next = state;
  next.covariance(kLatency, kLatency) = sigma_s * sigma_s;
  return next;
}

Mat6 covariance_of_base(const FusedState& state) { return state.covariance.block<6, 6>(kBase, kBase); }

FusedState without_base(const FusedState& state) {
  FusedState next = state;
  next.tracker_from_base.reset();
  next.covariance.middleRows<6>(kBase).setZero();
  next.covariance.middleCols<6>(kBase).setZero();
  return next;
}

}  // namespace asterism
