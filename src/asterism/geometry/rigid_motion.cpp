// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/rigid_motion.hpp"

#include <cmath>

namespace asterism {

Quaternion exp_rotation(const Vec3& omega) {
  const double angle = omega.norm();
  // sin(θ/2)/θ by its series where the quotient loses digits.
  const double scale = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
  return Quaternion(std::cos(0.5 * angle), scale * omega.x(), scale * omega.y(), scale * omega.z());
}

Vec3 log_rotation(const Quaternion& rotation) {
  const double sign = rotation.w() < 0 ? -1.0 : 1.0;
  const double sine = rotation.vec().norm();
  if (sine < 1e-12) return 2.0 * sign * rotation.vec();
  return (2.0 * std::atan2(sine, sign * rotation.w()) * sign / sine) * rotation.vec();
}

Mat3 left_jacobian(const Vec3& omega) {
  const double angle = omega.norm();
  const Mat3 s = skew(omega);
  if (angle < 1e-4) return Mat3::Identity() + 0.5 * s + s * s / 6.0;
  const double square = angle * angle;
  return Mat3::Identity() + (1.0 - std::cos(angle)) / square * s +
         (angle - std::sin(angle)) / (square * angle) * (s * s);
}

RigidMotion perturbed(const RigidMotion& motion, const Vec6& error) {
  return {(exp_rotation(error.head<3>()) * motion.rotation).normalized(),
          motion.translation + error.tail<3>()};
}

Vec6 difference(const RigidMotion& to, const RigidMotion& from) {
  Vec6 error;
  error << log_rotation(to.rotation * from.rotation.conjugate()), to.translation - from.translation;
  return error;
}

double rotation_angle(const Quaternion& a, const Quaternion& b) {
  return log_rotation(a * b.conjugate()).norm();
}

Quaternion rotation_from_yaw_pitch_roll(double yaw_rad, double pitch_rad, double roll_rad) {
  return exp_rotation({0, 0, yaw_rad}) * exp_rotation({0, pitch_rad, 0}) * exp_rotation({roll_rad, 0, 0});
}

Quaternion quaternion_from_matrix(const Mat3& rotation) {
  Quaternion q(rotation);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return q;
}

RigidMotion rotation_about(const Vec3& pivot, const Quaternion& rotation) {
  return {rotation, pivot - rotation * pivot};
}

Mat3 covariance_of_point(const RigidMotion& a_from_b, const Mat6& covariance, const Vec3& in_b) {
  Mat36 jacobian;
  jacobian << -skew(a_from_b.rotation * in_b), Mat3::Identity();
  return jacobian * covariance * jacobian.transpose();
}

Mat6 covariance_of_product(const RigidMotion& a_from_b, const Mat6& of_a_from_b, const RigidMotion& b_from_c,
                           const Mat6& of_b_from_c) {
  const Mat3 rotation = a_from_b.rotation.toRotationMatrix();
  Mat6 by_first = Mat6::Identity();
  by_first.bottomLeftCorner<3, 3>() = -skew(rotation * b_from_c.translation);
  Mat6 by_second = Mat6::Zero();
  by_second.topLeftCorner<3, 3>() = rotation;
  by_second.bottomRightCorner<3, 3>() = rotation;
  return by_first * of_a_from_b * by_first.transpose() + by_second * of_b_from_c * by_second.transpose();
}

Mat6 covariance_of_inverse(const RigidMotion& a_from_b, const Mat6& covariance) {
  const Mat3 back = a_from_b.rotation.conjugate().toRotationMatrix();
  Mat6 jacobian = Mat6::Zero();
  jacobian.topLeftCorner<3, 3>() = -back;
  jacobian.bottomLeftCorner<3, 3>() = -back * skew(a_from_b.translation);
  jacobian.bottomRightCorner<3, 3>() = -back;
  return jacobian * covariance * jacobian.transpose();
}

}  // namespace asterism
