// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/motion_model.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {

void describe(FilterOptions& options, OptionVisitor& visit) {
  visit.number("rate_wander_deg_s", options.rate_wander_deg_s, {0, 1e6},
               "by how much the turning rate changes in one second");
  visit.number("speed_wander_mm_s", options.speed_wander_mm_s, {0, 1e7},
               "by how much the speed changes in one second");
  visit.number("initial_rate_deg_s", options.initial_rate_deg_s, {0, 1e6},
               "turning rate a body may start with");
  visit.number("initial_speed_mm_s", options.initial_speed_mm_s, {0, 1e7}, "speed a body may start with");
  visit.number("gate_probability", options.gate_probability, {1e-12, 0.1},
               "of refusing a pose that fits the motion");
  visit.number("coast_max_s", options.coast_max_s, {0, 3600},
               "how long a body that is not seen is carried on");
}

MotionState first_state(double time_s, const RigidMotion& measured, const Mat6& noise,
                        const FilterOptions& options) {
  MotionState state{time_s, measured, Vec6::Zero(), Mat12::Zero()};
  state.covariance.topLeftCorner<6, 6>() = noise;
  state.covariance.diagonal().segment<3>(6).setConstant(
      std::pow(rad_from_deg(options.initial_rate_deg_s), 2));
  state.covariance.diagonal().tail<3>().setConstant(std::pow(options.initial_speed_mm_s, 2));
  return state;
}

Prediction predicted(const MotionState& state, double time_s, const FilterOptions& options) {
  const double dt = time_s - state.time_s;
  require(dt >= 0, "a motion is predicted forward in time");
  const Vec3 turn = state.twist.head<3>() * dt;
  const Vec3 velocity = state.twist.tail<3>();
  const Mat3 rotation = state.tracker_from_body.rotation.toRotationMatrix();
  const Mat3 v = left_jacobian(turn);
  const Vec3 way = rotation * v * velocity * dt;

  Prediction next{state, Mat12::Identity()};
  next.state.time_s = time_s;
  next.state.tracker_from_body.rotation =
      (state.tracker_from_body.rotation * exp_rotation(turn)).normalized();
  next.state.tracker_from_body.translation += way;
  Mat12& f = next.transition;
  f.block<3, 3>(3, 0) = -skew(way);
  f.block<3, 3>(0, 6) = rotation * v * dt;
  f.block<3, 3>(3, 6) = -0.5 * dt * dt * rotation * skew(velocity);
  f.block<3, 3>(3, 9) = rotation * v * dt;

  // White acceleration of spectral density q along the body's axes, integrated over dt.
  const double turning = std::pow(rad_from_deg(options.rate_wander_deg_s), 2);
  const double moving = std::pow(options.speed_wander_mm_s, 2);
  Mat12 q = Mat12::Zero();
  for (const auto& [at, density] : {std::pair(0, turning), std::pair(3, moving)}) {
    q.block<3, 3>(at, at) = density * dt * dt * dt / 3 * Mat3::Identity();
    q.block<3, 3>(at, at + 6) = density * dt * dt / 2 * rotation;
    q.block<3, 3>(at + 6, at) = density * dt * dt / 2 * rotation.transpose();
    q.block<3, 3>(at + 6, at + 6) = density * dt * Mat3::Identity();
  }
  next.state.covariance = f * state.covariance * f.transpose() + q;
  return next;
}

Vec6 twist_between(const RigidMotion& from, const RigidMotion& to, double seconds) {
  const Quaternion back = from.rotation.conjugate();
  const Vec3 turn = log_rotation(back * to.rotation);
  Vec6 twist;
  twist << turn / seconds,
      left_jacobian(turn).inverse() * (back * (to.translation - from.translation)) / seconds;
  return twist;
}

namespace {

Mat6 inverse_of_covariance(const Mat6& covariance) {
  const auto inverse = inverse_positive(covariance);
  require(inverse.has_value(), "a pose's covariance is positive definite");
  return *inverse;
}

double squared_distance(const MotionState& state, const RigidMotion& measured, const Mat6& noise) {
  const Vec6 innovation = difference(measured, state.tracker_from_body);
  return innovation.dot(inverse_of_covariance(state.covariance.topLeftCorner<6, 6>() + noise) * innovation);
}

}  // namespace

Update updated(const MotionState& state, bool fresh, double time_s, const RigidMotion& measured,
               const Mat6& noise, const FilterOptions& options) {
  Update update{predicted(state, time_s, options), {}, 0};
  update.nis = squared_distance(update.before.state, measured, noise);
  if (fresh && time_s > state.time_s) {
    MotionState turned = state;
    turned.twist = twist_between(state.tracker_from_body, measured, time_s - state.time_s);
    update.before = predicted(turned, time_s, options);
  }
  const MotionState& before = update.before.state;
  const Eigen::Matrix<double, 12, 6> cross = before.covariance.leftCols<6>();
  const Eigen::Matrix<double, 12, 6> gain = cross * inverse_of_covariance(cross.topRows<6>() + noise);
  update.state = moved(before, gain * difference(measured, before.tracker_from_body));
  // Joseph's form keeps the covariance positive definite.
  Mat12 keep = Mat12::Identity();
  keep.leftCols<6>() -= gain;
  update.state.covariance = keep * before.covariance * keep.transpose() + gain * noise * gain.transpose();
  return update;
}

double contradiction(const RigidMotion& predicted, const Mat6& covariance, const RigidMotion& measured) {
  const Vec6 off = difference(measured, predicted);
  const auto weighted = solve_positive(covariance, off);
  return weighted ? std::max(1.0, off.dot(*weighted) / 6) : 1.0;
}

Vec12 difference(const MotionState& to, const MotionState& from) {
  Vec12 error;
  error << difference(to.tracker_from_body, from.tracker_from_body), to.twist - from.twist;
  return error;
}

MotionState moved(const MotionState& state, const Vec12& error) {
  MotionState next = state;
  next.tracker_from_body = perturbed(state.tracker_from_body, error.head<6>());
  next.twist += error.tail<6>();
  return next;
}

}  // namespace asterism
