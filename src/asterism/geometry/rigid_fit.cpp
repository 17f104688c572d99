// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/rigid_fit.hpp"

#include <cmath>

#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

// Points closer to one line than this share of their spread leave the turn about it undetermined.
constexpr double kCollinear = 1e-4;

double rms_of(const RigidMotion& a_from_b, std::span<const Vec3> in_a, std::span<const Vec3> in_b) {
  double sum = 0;
  for (std::size_t i = 0; i < in_a.size(); ++i) sum += (in_a[i] - a_from_b * in_b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(in_a.size()));
}

}  // namespace

Result<RigidFit, RigidFitFailure> fit_rigid_motion(std::span<const Vec3> in_a, std::span<const Vec3> in_b,
                                                   std::span<const double> weights) {
  require(in_a.size() == in_b.size(), "a rigid fit takes pairs of points");
  require(weights.empty() || weights.size() == in_a.size(), "a rigid fit takes one weight a pair");
  if (in_a.size() < 3) return because(RigidFitFailure::TooFewPoints);

  double total = 0;
  Vec3 mean_a = Vec3::Zero();
  Vec3 mean_b = Vec3::Zero();
  for (std::size_t i = 0; i < in_a.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    total += w;
    mean_a += w * in_a[i];
    mean_b += w * in_b[i];
  }
  mean_a /= total;
  mean_b /= total;

  Mat3 cross = Mat3::Zero();
  for (std::size_t i = 0; i < in_a.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    cross += w * (in_a[i] - mean_a) * (in_b[i] - mean_b).transpose();
  }
  const Svd3 d = svd(cross);
  if (!(d.singular_values(1) > kCollinear * kCollinear * d.singular_values(0))) {
    return because(RigidFitFailure::Collinear);
  }
  Mat3 proper = Mat3::Identity();
  proper(2, 2) = d.u.determinant() * d.v.determinant() < 0 ? -1.0 : 1.0;

  RigidFit fit;
  fit.a_from_b.rotation = quaternion_from_matrix(d.u * proper * d.v.transpose());
  fit.a_from_b.translation = mean_a - fit.a_from_b.rotation * mean_b;
  fit.rms = rms_of(fit.a_from_b, in_a, in_b);
  return fit;
}

Result<RigidMotion, RigidFitFailure> frame_from_three_points(const Vec3& p1, const Vec3& p2, const Vec3& p3) {
  const Vec3 normal = (p2 - p1).cross(p3 - p1);
  const double spread = std::max((p2 - p1).squaredNorm(), (p3 - p1).squaredNorm());
  if (!(normal.norm() > kCollinear * spread)) return because(RigidFitFailure::Collinear);
  Mat3 axes;
  axes.col(0) = (p2 - p1).normalized();
  axes.col(2) = normal.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return RigidMotion{quaternion_from_matrix(axes), p1};
}

Result<RigidFit, RigidFitFailure> three_point_motion(std::span<const Vec3> in_a, std::span<const Vec3> in_b) {
  require(in_a.size() == in_b.size(), "a rigid fit takes pairs of points");
  if (in_a.size() < 3) return because(RigidFitFailure::TooFewPoints);
  const auto a_from_frame = frame_from_three_points(in_a[0], in_a[1], in_a[2]);
  const auto b_from_frame = frame_from_three_points(in_b[0], in_b[1], in_b[2]);
  if (!a_from_frame) return because(a_from_frame.error());
  if (!b_from_frame) return because(b_from_frame.error());
  RigidFit fit;
  fit.a_from_b = *a_from_frame * b_from_frame->inverse();
  fit.rms = rms_of(fit.a_from_b, in_a, in_b);
  return fit;
}

}  // namespace asterism
