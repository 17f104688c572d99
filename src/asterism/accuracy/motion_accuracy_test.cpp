// SPDX-License-Identifier: Apache-2.0
#include "asterism/accuracy/motion_accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/visibility/scene_for_tests.hpp"

namespace asterism {
namespace {

const std::vector<Vec3> kPoints = {{0, 0, 900}, {350, 0, 1100}, {-200, 250, 650}};

/// Every target seen by both cameras, and one here and there hidden from one or both.
MotionVisibility patchy(std::size_t targets, std::size_t poses) {
  MotionVisibility visibility{std::vector<std::array<TargetMask, 2>>(poses)};
  const TargetMask all = (TargetMask{1} << targets) - 1;
  for (std::size_t pose = 0; pose < poses; ++pose) {
    visibility.seen[pose] = {all, all};
    if (pose % 3 == 1) visibility.seen[pose][0] &= ~(TargetMask{1} << (pose % targets));
    if (pose % 5 == 2) visibility.seen[pose][1] &= ~(TargetMask{1} << ((pose + 2) % targets));
  }
  return visibility;
}

std::vector<Target> without_size(std::vector<Target> targets) {
  for (Target& target : targets) target.diameter_mm.reset();
  return targets;
}

/// The largest error over the points after the loss of some targets, the long way; none: not determined.
std::optional<double> the_long_way(const std::vector<Target>& targets, std::array<TargetMask, 2> seen,
                                   TargetMask lost, const RigidMotion& pose, const StereoRig& rig,
                                   const AccuracyOptions& options) {
  seen[0] &= ~lost;
  seen[1] &= ~lost;
  const auto accuracy = predict_pose_accuracy(targets, seen, pose, rig, options);
  if (!accuracy) return std::nullopt;
  double largest = 0;
  for (const Vec3& point : kPoints) {
    largest = std::max(largest, error_at_point_mm(pose, accuracy->covariance, point));
  }
  return largest;
}

/// The same over all ways to lose `losses` targets.
std::optional<double> worst_the_long_way(const std::vector<Target>& targets,
                                         const std::array<TargetMask, 2>& seen, const RigidMotion& pose,
                                         const StereoRig& rig, const AccuracyOptions& options, int losses) {
  double worst = 0;
  const std::size_t n = targets.size();
  for (std::size_t i = 0; i < (losses > 0 ? n : 1); ++i) {
    for (std::size_t j = losses > 1 ? i + 1 : i; j < (losses > 1 ? n : i + 1); ++j) {
      const TargetMask lost = losses > 0 ? TargetMask{1} << i | TargetMask{1} << j : 0;
      const auto error = the_long_way(targets, seen, lost, pose, rig, options);
      if (!error) return std::nullopt;
      worst = std::max(worst, *error);
    }
  }
  return worst;
}

void expect_as_the_long_way(const std::vector<Target>& targets, AccuracyOptions options) {
  const StereoRig rig = scene::rig();
  const std::vector<RigidMotion> poses = scene::motion(rig, 11);
  const MotionVisibility visibility = patchy(targets.size(), poses.size());
  options.losses = 2;
  const MotionAccuracy accuracy =
      predict_accuracy(targets, seen_motion(poses, rig), visibility, kPoints, options);
  ASSERT_EQ(accuracy.after.size(), 3U);
  for (int losses = 0; losses <= 2; ++losses) {
    const ErrorOverMotion& over = accuracy.after[static_cast<std::size_t>(losses)];
    ASSERT_EQ(over.by_pose_mm.size(), poses.size());
    for (std::size_t pose = 0; pose < poses.size(); ++pose) {
      const auto expected =
          worst_the_long_way(targets, visibility.seen[pose], poses[pose], rig, options, losses);
      ASSERT_EQ(std::isfinite(over.by_pose_mm[pose]), expected.has_value());
      if (!expected) continue;
      // The effect of a disc's slant on its image's centre is left out of the fast way.
      EXPECT_NEAR(over.by_pose_mm[pose], *expected, 1e-4 * *expected) << losses << " lost, pose " << pose;
    }
  }
}

TEST(PredictAccuracy, IsThatOfEachPoseAloneAfterEachLoss) {
  expect_as_the_long_way(scene::targets_of(scene::kTable1[2]), {});
}

TEST(PredictAccuracy, CountsTheMapsOwnDoubt) {
  std::vector<Target> targets = scene::targets_of(scene::kTable1[1]);
  targets[2].covariance = Vec3(1e-4, 4e-4, 9e-4).asDiagonal();
  AccuracyOptions options;
  options.map_sigma_mm = 0.03;
  expect_as_the_long_way(targets, options);
}

TEST(PredictAccuracy, CountsWhatTheSizeOfTheImageLets) {
  AccuracyOptions options;
  options.sigma_px = 0.005;
  options.bound = centre_bound(Sensor{}, Light{});
  expect_as_the_long_way(scene::targets_of(scene::kTable1[0]), options);
}

TEST(PredictAccuracy, LeavesOutSingleViewsWhereAsked) {
  AccuracyOptions options;
  options.single_views = false;
  expect_as_the_long_way(scene::targets_of(scene::kTable1[0]), options);
}

TEST(PredictAccuracy, IsExactForTargetsWithoutSize) {
  const StereoRig rig = scene::rig();
  const std::vector<RigidMotion> poses = scene::motion(rig, 5);
  const std::vector<Target> targets = without_size(scene::targets_of(scene::kTable9[1]));
  const MotionVisibility visibility = patchy(4, 5);
  const MotionAccuracy accuracy = predict_accuracy(targets, seen_motion(poses, rig), visibility, kPoints, {});
  for (std::size_t pose = 0; pose < 5; ++pose) {
    const auto expected = the_long_way(targets, visibility.seen[pose], 0, poses[pose], rig, {});
    EXPECT_NEAR(accuracy.nominal().by_pose_mm[pose], expected.value(), 1e-10);
  }
}

TEST(PredictAccuracy, NamesTheWorstPosePointAndLoss) {
  const StereoRig rig = scene::rig();
  const std::vector<RigidMotion> poses = scene::motion(rig, 30);
  const std::vector<Target> targets = without_size(scene::targets_of(scene::kTable1[2]));
  const MotionVisibility visibility = patchy(6, 30);
  AccuracyOptions options;
  options.losses = 2;
  const MotionAccuracy accuracy =
      predict_accuracy(targets, seen_motion(poses, rig), visibility, kPoints, options);
  for (std::size_t losses = 0; losses <= 2; ++losses) {
    const WorstError& worst = accuracy.after[losses].worst.value();
    EXPECT_EQ(worst.lost.size(), losses);
    std::array<TargetMask, 2> seen = visibility.seen[worst.pose];
    for (const std::size_t lost : worst.lost) {
      for (TargetMask& mask : seen) mask &= ~(TargetMask{1} << lost);
    }
    const auto alone = predict_pose_accuracy(targets, seen, poses[worst.pose], rig, options);
    EXPECT_NEAR(error_at_point_mm(poses[worst.pose], alone->covariance, kPoints[worst.point]), worst.mm,
                1e-10);
    EXPECT_EQ(worst.mm, *std::max_element(accuracy.after[losses].by_pose_mm.begin(),
                                          accuracy.after[losses].by_pose_mm.end()));
  }
  EXPECT_GT(accuracy.after[1].worst->mm, accuracy.after[0].worst->mm);
  EXPECT_GT(accuracy.after[2].worst->mm, accuracy.after[1].worst->mm);
  EXPECT_LT(accuracy.after[2].mean_mm, accuracy.after[2].worst->mm);
}

TEST(PredictAccuracy, CountsPosesThatAreNotDetermined) {
  const StereoRig rig = scene::rig();
  const std::vector<RigidMotion> poses = scene::motion(rig, 6);
  const std::vector<Target> targets = scene::targets_of(scene::kTable9[0]);
  MotionVisibility visibility = patchy(4, 6);
  for (auto& seen : visibility.seen) seen = {0b1111, 0b1111};
  visibility.seen[1] = {0, 0};
  visibility.seen[2] = {0b0001, 0b0001};
  visibility.seen[3] = {0b0011, 0b0011};
  visibility.seen[4] = {0b0111, 0b0111};
  AccuracyOptions options;
  options.losses = 2;
  const MotionAccuracy accuracy =
      predict_accuracy(targets, seen_motion(poses, rig), visibility, kPoints, options);
  EXPECT_EQ(accuracy.after[0].undetermined, 3U);
  EXPECT_EQ(accuracy.after[1].undetermined, 4U);
  EXPECT_EQ(accuracy.after[2].undetermined, 6U);
  EXPECT_FALSE(accuracy.after[2].worst.has_value());
  EXPECT_TRUE(std::isinf(accuracy.after[0].by_pose_mm[1]));
  EXPECT_TRUE(std::isfinite(accuracy.after[0].by_pose_mm[4]));
  EXPECT_TRUE(std::isfinite(accuracy.after[1].by_pose_mm[5]));
}

TEST(PredictAccuracy, DoesNotTakeTargetsOnALineForAPose) {
  const StereoRig rig = scene::rig();
  const std::vector<RigidMotion> poses = scene::motion(rig, 9);
  for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0.3, -0.7, 0.2)}) {
    const scene::Layout line = {-200 * along, 50 * along, 120 * along, 260 * along};
    const std::vector<Target> targets = without_size(scene::targets_of(line));
    const MotionAccuracy accuracy =
        predict_accuracy(targets, seen_motion(poses, rig), patchy(4, 9), kPoints, {});
    EXPECT_EQ(accuracy.after[0].undetermined, 9U);
    EXPECT_EQ(accuracy.after[1].undetermined, 9U);
  }
}

TEST(PredictAccuracy, DoesNotDependOnTheBodysFrame) {
  const StereoRig rig = scene::rig();
  std::vector<RigidMotion> poses = scene::motion(rig, 8);
  std::vector<Target> targets = scene::targets_of(scene::kTable1[0]);
  const MotionVisibility visibility = patchy(6, 8);
  const auto before = predict_accuracy(targets, seen_motion(poses, rig), visibility, kPoints, {});
  const RigidMotion elsewhere_from_body{rotation_from_yaw_pitch_roll(1, 0.4, -2), {3000, -800, 12000}};
  for (Target& target : targets) {
    target.position = elsewhere_from_body * target.position;
    target.normal = elsewhere_from_body.rotation * *target.normal;
  }
  for (RigidMotion& pose : poses) pose = pose * elsewhere_from_body.inverse();
  std::vector<Vec3> points;
  for (const Vec3& point : kPoints) points.push_back(elsewhere_from_body * point);
  const auto after = predict_accuracy(targets, seen_motion(poses, rig), visibility, points, {});
  for (std::size_t losses = 0; losses <= 1; ++losses) {
    EXPECT_NEAR(after.after[losses].worst->mm, before.after[losses].worst->mm, 1e-9);
    EXPECT_NEAR(after.after[losses].mean_mm, before.after[losses].mean_mm, 1e-9);
  }
}

TEST(PredictAccuracy, TakesTheTargetsMeanWhereNoPointIsNamed) {
  const StereoRig rig = scene::rig();
  const std::vector<RigidMotion> poses = scene::motion(rig, 4);
  const std::vector<Target> targets = scene::targets_of(scene::kTable1[0]);
  Vec3 mean = Vec3::Zero();
  for (const Target& target : targets) mean += target.position / 6;
  const auto visibility = patchy(6, 4);
  const SeenMotion motion = seen_motion(poses, rig);
  EXPECT_NEAR(predict_accuracy(targets, motion, visibility, {}, {}).nominal().mean_mm,
              predict_accuracy(targets, motion, visibility, {&mean, 1}, {}).nominal().mean_mm, 1e-12);
}

}  // namespace
}  // namespace asterism
