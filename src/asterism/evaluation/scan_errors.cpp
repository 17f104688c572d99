// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/scan_errors.hpp"

#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

Mat3 scanner_covariance(const CarriedPoint& point) {
  const auto& c = point.scanner_mm2;
  Mat3 full;
  full << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  return full;
}

}  // namespace

CloudErrors cloud_errors(std::span<const FusedPoint> cloud, const SurfaceTree& surface, double within_mm) {
  constexpr double k95 = 1.96;
  CloudErrors errors;
  double squares = 0, predicted = 0;
  for (const FusedPoint& point : cloud) {
    const auto nearest = surface.nearest(point.at, within_mm);
    if (!nearest) {
      ++errors.far_off;
      continue;
    }
    const double distance = nearest->signed_distance_mm;
    const double variance = nearest->normal.dot(point.covariance * nearest->normal);
    ++errors.points;
    errors.bias_mm += distance;
    squares += distance * distance;
    predicted += variance;
    errors.mean_nees += distance * distance / variance;
    errors.in_95_percent += distance * distance <= k95 * k95 * variance ? 1 : 0;
  }
  if (errors.points == 0) return errors;
  const auto count = static_cast<double>(errors.points);
  errors.bias_mm /= count;
  errors.rms_mm = std::sqrt(squares / count);
  errors.predicted_rms_mm = std::sqrt(predicted / count);
  errors.mean_nees /= count;
  errors.in_95_percent /= count;
  return errors;
}

CarriedErrors carried_errors(const CarriedScan& carried, std::span<const Vec3f> truth) {
  CarriedErrors errors;
  double squares = 0, predicted = 0;
  for (const CarriedPart& part : carried.parts) {
    for (const CarriedPoint& point : part.points) {
      require(errors.points < truth.size(), "a carried point has a truth");
      const ScannerPose& pose = carried.poses[point.pose];
      const Vec3 in_scanner = pose.workpiece_from_scanner.inverse() * point.at;
      const Mat3 covariance =
          scanner_covariance(point) +
          covariance_of_point(pose.workpiece_from_scanner, pose.noise + pose.systematic, in_scanner);
      const Vec3 off = point.at - truth[errors.points++].cast<double>();
      squares += off.squaredNorm();
      predicted += covariance.trace();
      errors.mean_nees += off.dot(covariance.inverse() * off);
    }
  }
  require(errors.points == truth.size(), "a truth belongs to a carried point");
  if (errors.points == 0) return errors;
  const auto count = static_cast<double>(errors.points);
  errors.rms_mm = std::sqrt(squares / count);
  errors.predicted_rms_mm = std::sqrt(predicted / count);
  errors.mean_nees /= count;
  return errors;
}

}  // namespace asterism
