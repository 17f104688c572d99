// SPDX-License-Identifier: Apache-2.0
// What accuracy predicts against what the tracker's own pose estimator makes of noisy centres.
#include <gtest/gtest.h>

#include <cmath>

#include "asterism/accuracy/motion_accuracy.hpp"
#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/tracking/scene_for_tests.hpp"

namespace asterism {
namespace {

constexpr double kSigma_px = 0.05;
constexpr int kDraws = 2000;
const Vec3 kPart(0, 0, 900);

/// Errors of the estimated pose and of a point of the part over many draws of the centres' noise, at one
/// pose.
struct Drawn {
  Mat6 covariance = Mat6::Zero();  // about the truth
  double rms_mm = 0;               // at the part
  double nees = 0;                 // mean of eᵀ C⁻¹ e with the predicted C
  int refused = 0;
};

Drawn draw(const StereoRig& rig, const Body& body, const RigidMotion& pose, const std::vector<int>& targets,
           const Mat6& predicted) {
  const Mat6 weight = inverse_positive(predicted).value();
  Drawn drawn;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(7, static_cast<std::uint64_t>(i));
    const auto views = scene::views(rig, body, pose, targets, kSigma_px, random);
    const auto found = estimate_pose(body, views, rig, pose, {});
    if (!found) {
      ++drawn.refused;
      continue;
    }
    const Vec6 error = difference(found->estimate.tracker_from_body, pose);
    drawn.covariance += error * error.transpose();
    drawn.nees += error.dot(weight * error);
    drawn.rms_mm += (found->estimate.tracker_from_body * kPart - pose * kPart).squaredNorm();
  }
  const double count = kDraws - drawn.refused;
  drawn.covariance /= count;
  drawn.nees /= count;
  drawn.rms_mm = std::sqrt(drawn.rms_mm / count);
  return drawn;
}

AccuracyOptions options() {
  AccuracyOptions options;
  options.sigma_px = kSigma_px;
  return options;
}

/// 2,000 draws tell a variance to √(2 / 2000) = 3.2 %; four of these, and the few draws in which the
/// estimator rejects a target.
constexpr double kVarianceBand = 0.13;

TEST(PredictedAccuracy, IsWhatTheTrackersPoseEstimatorReaches) {
  RandomStream random(3, 0);
  const StereoRig rig = scene::rig(5);
  const Body body = scene::body();
  for (const std::vector<int>& targets :
       {std::vector<int>{0, 1, 2, 3, 4, 5}, std::vector<int>{0, 1, 3, 5}, std::vector<int>{1, 2, 4}}) {
    const RigidMotion pose = scene::pose(random);
    TargetMask mask = 0;
    for (const int target : targets) mask |= TargetMask{1} << target;
    const PoseAccuracy predicted =
        predict_pose_accuracy(body.targets, {mask, mask}, pose, rig, options()).value();
    const Drawn drawn = draw(rig, body, pose, targets, predicted.covariance);
    EXPECT_LT(drawn.refused, kDraws / 100);
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR(drawn.covariance(k, k) / predicted.covariance(k, k), 1, kVarianceBand) << k;
    }
    // Mean of χ² with 6 degrees of freedom over the draws: 6 ± 4 √(12 / 2000).
    EXPECT_NEAR(drawn.nees, 6, 4 * std::sqrt(12.0 / kDraws) + 0.03);
    const double at_part = error_at_point_mm(pose, predicted.covariance, kPart);
    EXPECT_NEAR(drawn.rms_mm / at_part, 1, 0.5 * kVarianceBand);

    const RigidMotion poses[] = {pose};
    const MotionAccuracy fast =
        predict_accuracy(body.targets, seen_motion(poses, rig), {{{mask, mask}}}, {&kPart, 1}, options());
    EXPECT_NEAR(fast.nominal().worst->mm, at_part, 1e-4 * at_part);
  }
}

TEST(PredictedAccuracy, AfterALossIsWhatThePoseEstimatorReachesWithoutTheTarget) {
  RandomStream random(4, 0);
  const StereoRig rig = scene::rig(5);
  const Body body = scene::body();
  const RigidMotion poses[] = {scene::pose(random)};
  const MotionAccuracy predicted = predict_accuracy(body.targets, seen_motion(poses, rig),
                                                    {{{0b111111, 0b111111}}}, {&kPart, 1}, options());
  const WorstError& worst = predicted.after_losses().worst.value();
  ASSERT_EQ(worst.lost.size(), 1U);
  std::vector<int> left;
  for (int i = 0; i < 6; ++i) {
    if (static_cast<std::size_t>(i) != worst.lost[0]) left.push_back(i);
  }
  const Drawn drawn = draw(rig, body, poses[0], left, Mat6::Identity());
  EXPECT_NEAR(drawn.rms_mm / worst.mm, 1, 0.5 * kVarianceBand);
  EXPECT_GT(worst.mm, predicted.nominal().worst->mm);
}

TEST(PredictedAccuracy, StatesTheSameCovarianceAsTheEstimateItself) {
  RandomStream random(5, 0);
  const StereoRig rig = scene::rig(5);
  Body body = scene::body();
  for (Target& target : body.targets) target.covariance = Vec3(4e-4, 4e-4, 9e-4).asDiagonal();
  const RigidMotion pose = scene::pose(random);
  const auto views = scene::views(rig, body, pose, 1e-6, random);
  std::vector<TargetView> stated = views;
  for (TargetView& view : stated) view.covariance = kSigma_px * kSigma_px * Mat2::Identity();
  PoseOptions exact;
  exact.sigma_floor_px = 0;
  const auto found = estimate_pose(body, stated, rig, pose, exact);
  ASSERT_TRUE(found.has_value());
  const PoseAccuracy predicted =
      predict_pose_accuracy(body.targets, {0b111111, 0b111111}, pose, rig, options()).value();
  EXPECT_LT((found->estimate.covariance - predicted.covariance).norm(), 1e-5 * predicted.covariance.norm());
  EXPECT_LT((found->estimate.systematic - predicted.systematic).norm(), 1e-5 * predicted.covariance.norm());
}

}  // namespace
}  // namespace asterism
