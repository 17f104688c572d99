// SPDX-License-Identifier: Apache-2.0
#include "asterism/camera/lens.hpp"

#include <cmath>

namespace asterism {
namespace {

enum Coefficient { k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tau_x, tau_y };

/// The tilted-sensor homography of the 14-coefficient model, and its derivatives by the two angles.
struct Tilt {
  Mat3 h, by_x, by_y;
};

Tilt tilt_homography(double tx, double ty) {
  const double cx = std::cos(tx), sx = std::sin(tx), cy = std::cos(ty), sy = std::sin(ty);
  Mat3 rx, ry, drx, dry;
  rx << 1, 0, 0, 0, cx, sx, 0, -sx, cx;
  ry << cy, 0, -sy, 0, 1, 0, sy, 0, cy;
  drx << 0, 0, 0, 0, -sx, cx, 0, -cx, -sx;
  dry << -sy, 0, -cy, 0, 0, 0, cy, 0, -sy;
  const Mat3 r = ry * rx;
  const auto lift = [](const Mat3& m) {
    Mat3 z;
    z << m(2, 2), 0, -m(0, 2), 0, m(2, 2), -m(1, 2), 0, 0, 1;
    return z;
  };
  const auto lift_derivative = [](const Mat3& m) {
    Mat3 z;
    z << m(2, 2), 0, -m(0, 2), 0, m(2, 2), -m(1, 2), 0, 0, 0;
    return z;
  };
  const Mat3 by_x = ry * drx;
  const Mat3 by_y = dry * rx;
  const Mat3 z = lift(r);
  return {z * r, lift_derivative(by_x) * r + z * by_x, lift_derivative(by_y) * r + z * by_y};
}

struct Radial {
  double r2, numerator, denominator;
};

Radial radial_terms(const Lens& lens, const Vec2& xy) {
  const auto& d = lens.distortion;
  const double r2 = xy.squaredNorm();
  return {r2, 1 + r2 * (d[k1] + r2 * (d[k2] + r2 * d[k3])), 1 + r2 * (d[k4] + r2 * (d[k5] + r2 * d[k6]))};
}

/// All but the sensor's tilt.
DistortionResult distort_before_tilt(const Lens& lens, const Vec2& xy) {
  const auto& d = lens.distortion;
  const auto [r2, numerator, denominator] = radial_terms(lens, xy);
  const double x = xy.x(), y = xy.y();
  const double radial = numerator / denominator;
  const double numerator_by_r2 = d[k1] + r2 * (2 * d[k2] + 3 * r2 * d[k3]);
  const double denominator_by_r2 = d[k4] + r2 * (2 * d[k5] + 3 * r2 * d[k6]);
  const double radial_by_r2 = (numerator_by_r2 - radial * denominator_by_r2) / denominator;

  DistortionResult result;
  result.xy = {x * radial + 2 * d[p1] * x * y + d[p2] * (r2 + 2 * x * x) + r2 * (d[s1] + r2 * d[s2]),
               y * radial + d[p1] * (r2 + 2 * y * y) + 2 * d[p2] * x * y + r2 * (d[s3] + r2 * d[s4])};
  const double prism_x = d[s1] + 2 * r2 * d[s2];
  const double prism_y = d[s3] + 2 * r2 * d[s4];
  const double mixed = 2 * x * y * radial_by_r2;
  result.by_xy << radial + 2 * x * x * radial_by_r2 + 2 * d[p1] * y + 6 * d[p2] * x + 2 * x * prism_x,
      mixed + 2 * d[p1] * x + 2 * d[p2] * y + 2 * y * prism_x,
      mixed + 2 * d[p1] * x + 2 * d[p2] * y + 2 * x * prism_y,
      radial + 2 * y * y * radial_by_r2 + 6 * d[p1] * y + 2 * d[p2] * x + 2 * y * prism_y;
  return result;
}

/// (x, y) ↦ H (x, y, 1), dehomogenised, with its Jacobian.
DistortionResult apply_homography(const Mat3& h, const Vec2& xy) {
  const Vec3 lifted = h * xy.homogeneous();
  DistortionResult result;
  result.xy = lifted.hnormalized();
  result.by_xy = (h.topLeftCorner<2, 2>() - result.xy * h.bottomLeftCorner<1, 2>()) / lifted.z();
  return result;
}

}  // namespace

DistortionResult distort(const Lens& lens, const Vec2& xy) {
  if (lens.coefficients == 0) return {xy, Mat2::Identity()};
  DistortionResult result = distort_before_tilt(lens, xy);
  if (lens.coefficients < 14) return result;
  const Tilt tilt = tilt_homography(lens.distortion[tau_x], lens.distortion[tau_y]);
  const DistortionResult tilted = apply_homography(tilt.h, result.xy);
  return {tilted.xy, tilted.by_xy * result.by_xy};
}

Mat3 sensor_tilt(const Lens& lens) {
  if (lens.coefficients < 14) return Mat3::Identity();
  return tilt_homography(lens.distortion[tau_x], lens.distortion[tau_y]).h;
}

Vec2 pixel_from_normalised(const Lens& lens, const Vec2& xy) {
  return {lens.fx * xy.x() + lens.skew * xy.y() + lens.cx, lens.fy * xy.y() + lens.cy};
}

Mat2 pixel_by_normalised(const Lens& lens) {
  Mat2 k;
  k << lens.fx, lens.skew, 0, lens.fy;
  return k;
}

Result<Projection, LensFailure> project(const Lens& lens, const Vec3& in_camera) {
  if (!(in_camera.z() > 0)) return because(LensFailure::BehindCamera);
  const double inverse_z = 1.0 / in_camera.z();
  const Vec2 xy = in_camera.head<2>() * inverse_z;
  const DistortionResult distorted = distort(lens, xy);
  Mat23 xy_by_point;
  xy_by_point << inverse_z, 0, -xy.x() * inverse_z, 0, inverse_z, -xy.y() * inverse_z;
  return Projection{pixel_from_normalised(lens, distorted.xy),
                    pixel_by_normalised(lens) * distorted.by_xy * xy_by_point};
}

Result<SightLine, LensFailure> sight_line(const Lens& lens, const Vec2& px) {
  const double distorted_y = (px.y() - lens.cy) / lens.fy;
  const Vec2 distorted((px.x() - lens.cx - lens.skew * distorted_y) / lens.fx, distorted_y);
  const Mat2 normalised_by_pixel = pixel_by_normalised(lens).inverse();
  if (lens.coefficients == 0) return SightLine{distorted, normalised_by_pixel};

  Vec2 xy = distorted;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const DistortionResult at = distort(lens, xy);
    // Beyond the fold the map is orientation-reversing: a root there is no sight line.
    if (!(at.by_xy.determinant() > 0)) return because(LensFailure::NoConvergence);
    const Mat2 back = at.by_xy.inverse();
    Vec2 step = back * (distorted - at.xy);
    const double longest = 0.5 * (1.0 + xy.norm());
    if (step.norm() > longest) step *= longest / step.norm();
    xy += step;
    if (step.norm() < 1e-13 * (1.0 + xy.norm())) {
      const DistortionResult end = distort(lens, xy);
      if (!(end.by_xy.determinant() > 0)) return because(LensFailure::NoConvergence);
      return SightLine{xy, end.by_xy.inverse() * normalised_by_pixel};
    }
  }
  return because(LensFailure::NoConvergence);
}

ParameterJacobian pixel_by_parameters(const Lens& lens, const Vec2& undistorted_xy) {
  const double x = undistorted_xy.x(), y = undistorted_xy.y();
  const auto [r2, numerator, denominator] = radial_terms(lens, undistorted_xy);
  const double radial = numerator / denominator;
  const double r4 = r2 * r2, r6 = r4 * r2;

  // By distortion coefficient, in normalised coordinates before the tilt.
  Eigen::Matrix<double, 2, 14> by;
  by.setZero();
  const Vec2& xy = undistorted_xy;
  by.col(k1) = xy * (r2 / denominator);
  by.col(k2) = xy * (r4 / denominator);
  by.col(p1) = Vec2(2 * x * y, r2 + 2 * y * y);
  by.col(p2) = Vec2(r2 + 2 * x * x, 2 * x * y);
  by.col(k3) = xy * (r6 / denominator);
  by.col(k4) = -xy * (radial * r2 / denominator);
  by.col(k5) = -xy * (radial * r4 / denominator);
  by.col(k6) = -xy * (radial * r6 / denominator);
  by.col(s1) = Vec2(r2, 0);
  by.col(s2) = Vec2(r4, 0);
  by.col(s3) = Vec2(0, r2);
  by.col(s4) = Vec2(0, r4);

  Vec2 distorted = distort(lens, undistorted_xy).xy;
  if (lens.coefficients == 14) {
    const Tilt tilt = tilt_homography(lens.distortion[tau_x], lens.distortion[tau_y]);
    const Vec2 before = distort_before_tilt(lens, undistorted_xy).xy;
    const Vec3 lifted = tilt.h * before.homogeneous();
    by.leftCols<12>() = (apply_homography(tilt.h, before).by_xy * by.leftCols<12>()).eval();
    const auto by_angle = [&](const Mat3& derivative) {
      const Vec3 d = derivative * before.homogeneous();
      return Vec2((d.head<2>() - distorted * d.z()) / lifted.z());
    };
    by.col(tau_x) = by_angle(tilt.by_x);
    by.col(tau_y) = by_angle(tilt.by_y);
  }

  ParameterJacobian jacobian(2, 5 + lens.coefficients);
  jacobian.leftCols<5>() << distorted.x(), 0, distorted.y(), 1, 0, 0, distorted.y(), 0, 0, 1;
  if (lens.coefficients > 0) {
    jacobian.rightCols(lens.coefficients) = pixel_by_normalised(lens) * by.leftCols(lens.coefficients);
  }
  return jacobian;
}

}  // namespace asterism
