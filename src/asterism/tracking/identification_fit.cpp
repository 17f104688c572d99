// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

// Kabsch starts within a few sigma of the optimum; each step then gains two digits or more.
constexpr int kSteps = 4;
constexpr double kStepEnough = 1e-4;  // standard deviations

const UncertainPoint& of(std::span<const UncertainPoint> points, int index) {
  return points[static_cast<std::size_t>(index)];
}

Result<RigidFit, RigidFitFailure> start(std::span<const Correspondence> labels,
                                        std::span<const UncertainPoint> targets,
                                        std::span<const UncertainPoint> scene) {
  std::vector<Vec3> in_tracker, in_body;
  std::vector<double> weights;
  for (const auto& label : labels) {
    in_tracker.push_back(of(scene, label.scene).position);
    in_body.push_back(of(targets, label.pattern).position);
    weights.push_back(
        1.0 / (of(scene, label.scene).covariance.trace() + of(targets, label.pattern).covariance.trace()));
  }
  return fit_rigid_motion(in_tracker, in_body, weights);
}

/// Sums of one Gauss–Newton step, and the fit's quality where it starts.
struct Normal {
  Mat6 information = Mat6::Zero();
  Vec6 gradient = Vec6::Zero();
};

Normal linearise(std::span<const Correspondence> labels, std::span<const UncertainPoint> targets,
                 std::span<const UncertainPoint> scene, LabelFit& fit) {
  const Mat3 rotation = fit.tracker_from_body.rotation.toRotationMatrix();
  Normal normal;
  double squares = 0;
  fit.chi_square = 0;
  fit.log_det_covariances = 0;
  for (const Correspondence& label : labels) {
    const UncertainPoint& target = of(targets, label.pattern);
    const UncertainPoint& point = of(scene, label.scene);
    const Vec3 turned = rotation * target.position;
    const Vec3 residual = point.position - turned - fit.tracker_from_body.translation;
    const Mat3 covariance = point.covariance + rotation * target.covariance * rotation.transpose();
    const Mat3 weight = covariance.inverse();
    const Vec3 weighted = weight * residual;
    const Mat3 cross = skew(turned);
    const Mat3 turned_weight = cross * weight;
    normal.information.topLeftCorner<3, 3>() -= turned_weight * cross;
    normal.information.topRightCorner<3, 3>() += turned_weight;
    normal.information.bottomRightCorner<3, 3>() += weight;
    normal.gradient.head<3>() += turned.cross(weighted);
    normal.gradient.tail<3>() += weighted;
    fit.chi_square += residual.dot(weighted);
    squares += residual.squaredNorm();
    fit.log_det_covariances += std::log(covariance.determinant());
  }
  normal.information.bottomLeftCorner<3, 3>() = normal.information.topRightCorner<3, 3>().transpose();
  fit.rms_mm = std::sqrt(squares / static_cast<double>(labels.size()));
  fit.information = normal.information;
  return normal;
}

double log_choose(std::size_t n, std::size_t k) {
  const auto log_factorial = [](std::size_t m) { return std::lgamma(static_cast<double>(m) + 1.0); };
  return log_factorial(n) - log_factorial(k) - log_factorial(n - k);
}

}  // namespace

Result<LabelFit, RigidFitFailure> fit_labels(std::span<const Correspondence> labels,
                                             std::span<const UncertainPoint> targets,
                                             std::span<const UncertainPoint> scene) {
  const auto begin = start(labels, targets, scene);
  if (!begin) return because(begin.error());
  LabelFit fit;
  fit.tracker_from_body = begin->a_from_b;
  Normal normal = linearise(labels, targets, scene, fit);
  for (int step = 0; step < kSteps; ++step) {
    const auto move = solve_positive(normal.information, normal.gradient);
    if (!move) return because(RigidFitFailure::Collinear);
    if (move->dot(normal.gradient) < kStepEnough * kStepEnough) break;
    fit.tracker_from_body = perturbed(fit.tracker_from_body, *move);
    normal = linearise(labels, targets, scene, fit);
  }
  return fit;
}

double chi_square_limit(double sigma, double degrees) {
  const double width = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - width + sigma * std::sqrt(width), 3);
}

double log_ball_volume(double dimensions, double radius) {
  return 0.5 * dimensions * std::log(std::numbers::pi) - std::lgamma(0.5 * dimensions + 1.0) +
         dimensions * std::log(radius);
}

double log_accidental_fits_within(double log_pose_volume, const LabelFit& fit, std::size_t labels,
                                  std::size_t targets, const Clutter& clutter) {
  const double degrees = 3.0 * static_cast<double>(labels) - 6.0;
  // A fit that is better than fits are on average is luck, not evidence.
  const double radius = std::sqrt(std::max(fit.chi_square, degrees));
  const double log_det = log_determinant_positive(fit.information).value_or(0.0);
  return log_choose(targets, labels) + static_cast<double>(labels) * std::log(clutter.density_per_mm3) +
         log_pose_volume + 0.5 * log_det + 0.5 * fit.log_det_covariances + log_ball_volume(degrees, radius);
}

double log_accidental_fits(const LabelFit& fit, std::size_t labels, std::size_t targets,
                           const Clutter& clutter) {
  const double log_pose_volume = std::log(8.0 * std::numbers::pi * std::numbers::pi) +
                                 std::log(clutter.points) - std::log(clutter.density_per_mm3);
  return log_accidental_fits_within(log_pose_volume, fit, labels, targets, clutter);
}

}  // namespace asterism
