// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/accuracy_agreement.hpp"

#include <bit>
#include <cmath>

#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

/// Sums over poses; RMS and means come at the end.
struct Sums {
  std::vector<double> simulated, predicted;  // squares, by point
  std::size_t poses = 0;
  double nees = 0, stated_nees = 0;
};

double nees_of(const Vec6& error, const Mat6& covariance) {
  const auto weighted = solve_positive(covariance, error);
  return weighted ? error.dot(*weighted) : 0.0;
}

NeesAgreement agreement_of(double sum, std::size_t poses) {
  if (poses == 0) return {};
  return {poses, sum / static_cast<double>(poses), chi_square_mean_band(poses, 6)};
}

bool outside(double nees, std::size_t poses, std::size_t frames) {
  const double confidence = 1 - 0.05 / static_cast<double>(frames);
  return !chi_square_mean_band(poses, 6, confidence).holds(nees / static_cast<double>(poses));
}

}  // namespace

AccuracyAgreement compare_roads(const PredictedAccuracy& predicted,
                                std::span<const std::vector<SimulatedPose>> repeats,
                                const MotionVisibility& visibility) {
  AccuracyAgreement agreement;
  Sums sums;
  sums.simulated.resize(predicted.points.size());
  sums.predicted.resize(predicted.points.size());
  for (std::size_t frame = 0; frame < predicted.poses.size(); ++frame) {
    const auto& bound = predicted.poses[frame];
    const int expected = std::popcount(visibility.seen[frame][0] | visibility.seen[frame][1]);
    double frame_nees = 0;
    std::size_t frame_poses = 0;
    bool unpredicted = false, missed = false, other = false;
    for (const std::vector<SimulatedPose>& repeat : repeats) {
      const SimulatedPose& pose = repeat[frame];
      agreement.wrong += pose.wrong ? 1 : 0;
      unpredicted = unpredicted || (pose.error && !bound);
      missed = missed || (!pose.error && bound);
      if (!pose.error || pose.wrong || !bound) continue;
      other = other || pose.targets != expected;
      for (std::size_t i = 0; i < predicted.points.size(); ++i) {
        sums.simulated[i] += error_at(pose, predicted.points[i].point.in_body_mm).squaredNorm();
        sums.predicted[i] += predicted.points[i].covariance[frame]->trace();
      }
      frame_nees += nees_of(*pose.error, bound->covariance);
      sums.stated_nees += nees_of(*pose.error, *pose.covariance);
      ++frame_poses;
    }
    if (unpredicted) agreement.unpredicted.push_back(frame);
    if (missed) agreement.missed.push_back(frame);
    if (other) agreement.other_targets.push_back(frame);
    if (frame_poses > 0 && outside(frame_nees, frame_poses, predicted.poses.size()))
      agreement.outside.push_back(frame);
    sums.nees += frame_nees;
    sums.poses += frame_poses;
  }
  agreement.predicted = agreement_of(sums.nees, sums.poses);
  agreement.stated = agreement_of(sums.stated_nees, sums.poses);
  if (sums.poses == 0) return agreement;
  for (std::size_t i = 0; i < predicted.points.size(); ++i) {
    const double poses = static_cast<double>(sums.poses);
    agreement.points.push_back({predicted.points[i].point.name, std::sqrt(sums.simulated[i] / poses),
                                std::sqrt(sums.predicted[i] / poses)});
  }
  return agreement;
}

}  // namespace asterism
