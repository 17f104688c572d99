// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

namespace asterism {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;  // where there are millions of them
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat23 = Eigen::Matrix<double, 2, 3>;
using Mat26 = Eigen::Matrix<double, 2, 6>;
using Mat36 = Eigen::Matrix<double, 3, 6>;
using Quaternion = Eigen::Quaterniond;

[[nodiscard]] constexpr double rad_from_deg(double deg) { return deg * (std::numbers::pi / 180.0); }
[[nodiscard]] constexpr double deg_from_rad(double rad) { return rad * (180.0 / std::numbers::pi); }

/// The matrix of the cross product: skew(a) b = a × b.
[[nodiscard]] inline Mat3 skew(const Vec3& a) {
  Mat3 s;
  s << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return s;
}

}  // namespace asterism
