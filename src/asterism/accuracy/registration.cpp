// SPDX-License-Identifier: Apache-2.0
#include "asterism/accuracy/registration.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

/// The targets' mean, principal axes and mean square distances from them.
struct Spread {
  Vec3 mean;
  Mat3 axes;           // columns
  Vec3 from_axis_mm2;  // f_k²
};

std::optional<Spread> spread_of(std::span<const Vec3> targets) {
  if (targets.size() < 3) return std::nullopt;
  const double count = static_cast<double>(targets.size());
  Spread spread;
  spread.mean.setZero();
  for (const Vec3& p : targets) spread.mean += p / count;
  Mat3 scatter = Mat3::Zero();
  for (const Vec3& p : targets) scatter += (p - spread.mean) * (p - spread.mean).transpose() / count;
  const SymmetricEigen3 eigen = symmetric_eigen(scatter);
  spread.axes = eigen.vectors;
  spread.from_axis_mm2 = Vec3::Constant(eigen.values.sum()) - eigen.values;
  // Points on a line have no extent about it; what rounding leaves is no extent.
  if (!(spread.from_axis_mm2.minCoeff() > 1e-12 * spread.from_axis_mm2.maxCoeff())) return std::nullopt;
  return spread;
}

}  // namespace

Mat6 registration_information(std::span<const Vec3> targets, double sigma_mm) {
  require(sigma_mm > 0, "a sigma is positive");
  Mat6 information = Mat6::Zero();
  for (const Vec3& p : targets) {
    Mat36 by_pose;
    by_pose << -skew(p), Mat3::Identity();
    information += by_pose.transpose() * by_pose;
  }
  return information / (sigma_mm * sigma_mm);
}

std::optional<double> registration_rotation_error_rad(std::span<const Vec3> targets, double sigma_mm) {
  const auto spread = spread_of(targets);
  if (!spread) return std::nullopt;
  const double variance = sigma_mm * sigma_mm / static_cast<double>(targets.size());
  return std::sqrt(variance * spread->from_axis_mm2.cwiseInverse().sum());
}

std::optional<double> registration_error_mm(std::span<const Vec3> targets, const Vec3& point,
                                            double sigma_mm) {
  const auto spread = spread_of(targets);
  if (!spread) return std::nullopt;
  const Vec3 along = spread->axes.transpose() * (point - spread->mean);
  const Vec3 from_axis = Vec3::Constant(along.squaredNorm()) - along.cwiseAbs2();
  const double ratio = from_axis.cwiseQuotient(spread->from_axis_mm2).sum();
  return sigma_mm * std::sqrt((3 + ratio) / static_cast<double>(targets.size()));
}

std::optional<double> registration_error_after_loss_mm(std::span<const Vec3> targets, const Vec3& point,
                                                       double sigma_mm) {
  std::optional<double> worst;
  for (std::size_t lost = 0; lost < targets.size(); ++lost) {
    std::vector<Vec3> left(targets.begin(), targets.end());
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(lost));
    const auto error = registration_error_mm(left, point, sigma_mm);
    if (!error) return std::nullopt;
    worst = std::max(worst.value_or(0.0), *error);
  }
  return worst;
}

}  // namespace asterism
