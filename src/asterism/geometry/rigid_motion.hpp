// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/geometry/types.hpp"

namespace asterism {

/// A rigid motion, named `a_from_b`: takes coordinates in frame b to coordinates in frame a.
///   x_a = rotation · x_b + translation
///
/// Its small error is told along the axes of `a`, the destination: R = exp(ω) R̂, t = t̂ + δ, with the
/// 6-vector in the order ω (rad), δ (mm); δ is the error at the origin of b.
struct RigidMotion {
  Quaternion rotation = Quaternion::Identity();
  Vec3 translation = Vec3::Zero();  // mm

  [[nodiscard]] Vec3 operator*(const Vec3& in_b) const { return rotation * in_b + translation; }
  [[nodiscard]] RigidMotion operator*(const RigidMotion& b_from_c) const {
    return {(rotation * b_from_c.rotation).normalized(), rotation * b_from_c.translation + translation};
  }
  [[nodiscard]] RigidMotion inverse() const {
    const Quaternion r = rotation.conjugate();
    return {r, -(r * translation)};
  }
};

/// Rotation by the vector `omega` (axis times angle, rad), and back (angle in [0, π]).
[[nodiscard]] Quaternion exp_rotation(const Vec3& omega);
[[nodiscard]] Vec3 log_rotation(const Quaternion& rotation);

/// The left Jacobian of SO(3): exp(ω + dω) ≈ exp(J dω) exp(ω).
[[nodiscard]] Mat3 left_jacobian(const Vec3& omega);

/// exp(ω) R, t + δ.
[[nodiscard]] RigidMotion perturbed(const RigidMotion& motion, const Vec6& error);
/// The error (ω, δ) that takes `from` to `to`.
[[nodiscard]] Vec6 difference(const RigidMotion& to, const RigidMotion& from);

/// Angle between two attitudes, rad.
[[nodiscard]] double rotation_angle(const Quaternion& a, const Quaternion& b);

/// Platform attitude: Rz(yaw) Ry(pitch) Rx(roll).
[[nodiscard]] Quaternion rotation_from_yaw_pitch_roll(double yaw_rad, double pitch_rad, double roll_rad);

/// Rotation matrix to quaternion with w ≥ 0.
[[nodiscard]] Quaternion quaternion_from_matrix(const Mat3& rotation);

/// The motion about a stated pivot: x ↦ pivot + R (x − pivot).
[[nodiscard]] RigidMotion rotation_about(const Vec3& pivot, const Quaternion& rotation);

// Covariances, all 6×6 in the order ω, δ along the destination's axes.

/// Covariance of a point fixed in b, seen in a.
[[nodiscard]] Mat3 covariance_of_point(const RigidMotion& a_from_b, const Mat6& covariance, const Vec3& in_b);

/// Covariance of `a_from_b * b_from_c`, both errors independent.
[[nodiscard]] Mat6 covariance_of_product(const RigidMotion& a_from_b, const Mat6& of_a_from_b,
                                         const RigidMotion& b_from_c, const Mat6& of_b_from_c);

/// Covariance of the inverse.
[[nodiscard]] Mat6 covariance_of_inverse(const RigidMotion& a_from_b, const Mat6& covariance);

}  // namespace asterism
