// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/predicted_accuracy.hpp"

#include <cmath>

#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

/// From the poses.
void fill_points(PredictedAccuracy& predicted, std::span<const RigidMotion> tracker_from_body) {
  predicted.undetermined = 0;
  for (const auto& pose : predicted.poses) predicted.undetermined += pose ? 0 : 1;
  for (PredictedPoint& at : predicted.points) {
    at.covariance.assign(predicted.poses.size(), {});
    for (std::size_t i = 0; i < predicted.poses.size(); ++i) {
      if (!predicted.poses[i]) continue;
      at.covariance[i] =
          covariance_of_point(tracker_from_body[i], predicted.poses[i]->covariance, at.point.in_body_mm);
    }
  }
}

}  // namespace

std::optional<double> PredictedPoint::error_mm(std::size_t frame) const {
  if (!covariance[frame]) return std::nullopt;
  return std::sqrt(covariance[frame]->trace());
}

std::optional<double> PredictedAccuracy::rotation_deg(std::size_t frame) const {
  if (!poses[frame]) return std::nullopt;
  return deg_from_rad(std::sqrt(poses[frame]->covariance.topLeftCorner<3, 3>().trace()));
}

PredictedAccuracy predict_along(std::span<const Target> targets, const StereoRig& rig,
                                std::span<const RigidMotion> tracker_from_body,
                                const MotionVisibility& visibility, std::span<const WorkPoint> points,
                                const AccuracyOptions& options) {
  require(visibility.poses() == tracker_from_body.size(), "visibility has a row a pose");
  PredictedAccuracy predicted;
  predicted.poses.resize(tracker_from_body.size());
  parallel_for(tracker_from_body.size(), [&](std::size_t i) {
    const auto accuracy =
        predict_pose_accuracy(targets, visibility.seen[i], tracker_from_body[i], rig, options);
    if (accuracy) predicted.poses[i] = *accuracy;
  });
  for (const WorkPoint& point : points) predicted.points.push_back({point, {}});
  fill_points(predicted, tracker_from_body);
  return predicted;
}

PredictedAccuracy with_covariances(const PredictedAccuracy& predicted,
                                   std::span<const RigidMotion> tracker_from_body,
                                   std::span<const std::optional<Mat6>> covariances) {
  PredictedAccuracy other = predicted;
  for (std::size_t i = 0; i < other.poses.size(); ++i) {
    other.poses[i].reset();
    if (covariances[i]) other.poses[i] = PoseAccuracy{*covariances[i], Mat6::Zero()};
  }
  fill_points(other, tracker_from_body);
  return other;
}

std::optional<WorstMoment> worst_moment(const PredictedAccuracy& predicted, std::size_t first,
                                        std::size_t last) {
  std::optional<WorstMoment> worst;
  for (std::size_t point = first; point < last; ++point) {
    for (std::size_t frame = 0; frame < predicted.poses.size(); ++frame) {
      const auto error = predicted.points[point].error_mm(frame);
      if (error && (!worst || *error > worst->error_mm)) worst = WorstMoment{point, frame, *error};
    }
  }
  return worst;
}

std::optional<WorstMoment> worst_moment(const PredictedAccuracy& predicted) {
  const std::size_t last = predicted.points.size();
  return worst_moment(predicted, last > VerifiedBody::kFirstNamed ? VerifiedBody::kFirstNamed : 0, last);
}

AccuracyOptions accuracy_options_of(const Cell& cell, CentreLevel level) {
  AccuracyOptions options;
  options.map_sigma_mm = 0;  // targets state their covariance (stated_belief)
  options.sigma_px = cell.noise.sigma_px;
  if (level == CentreLevel::Centres) return options;
  // No centre is better than the estimator's floor.
  options.sigma_px = 0.0005;
  options.bound = centre_bound(cell.sensor, cell.light);
  return options;
}

}  // namespace asterism
