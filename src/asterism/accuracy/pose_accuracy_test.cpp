// SPDX-License-Identifier: Apache-2.0
#include "asterism/accuracy/pose_accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/accuracy/registration.hpp"
#include "asterism/camera/disc_image.hpp"
#include "asterism/visibility/scene_for_tests.hpp"

namespace asterism {
namespace {

constexpr std::array<TargetMask, 2> kAll = {0b111111, 0b111111};

StereoRig parallel(double focal_px, double baseline_mm) {
  StereoRig rig = rig_of({2048, 1536, focal_px, baseline_mm, 1e9});
  rig.right_from_left = {Quaternion::Identity(), {-baseline_mm, 0, 0}};
  return rig;
}

Vec3 sigmas(const Mat3& covariance) { return covariance.diagonal().cwiseSqrt(); }

TEST(PredictPointCovariance, IsTheTextbooksForParallelCameras) {
  const double f = 3000, b = 1000, z = 2600, s = 0.05;
  const StereoRig rig = parallel(f, b);
  const Vec3 middle = sigmas(predict_point_covariance({0.5 * b, 0, z}, rig, s).value());
  EXPECT_NEAR(middle.z(), std::sqrt(2) * s * z * z / (b * f), 1e-9);
  EXPECT_NEAR(middle.y(), s * z / (std::sqrt(2) * f), 1e-9);
  EXPECT_NEAR(middle.x(), s * z / (std::sqrt(2) * f), 1e-9);
  // Away from the middle the depth's error leans over: by x/z and y/z.
  const Vec3 aside = sigmas(predict_point_covariance({0.5 * b + 368, 153, z}, rig, s).value());
  EXPECT_NEAR(aside.x(), 0.038, 5e-4);
  EXPECT_NEAR(aside.y(), 0.032, 5e-4);
  EXPECT_NEAR(aside.z(), 0.159, 5e-4);
}

TEST(PredictPointCovariance, KnowsNothingOfAPointBehindACamera) {
  EXPECT_EQ(predict_point_covariance({0, 0, -100}, parallel(3000, 1000), 0.05).error(),
            AccuracyFailure::BehindCamera);
}

/// Central differences of the exact image of each disc by the pose's error.
Mat6 information_by_differences(const std::vector<Target>& targets, const RigidMotion& pose,
                                const StereoRig& rig, double sigma_px) {
  Mat6 sum = Mat6::Zero();
  for (const Target& target : targets) {
    for (const Side side : {Side::Left, Side::Right}) {
      const auto image = [&](const Vec6& error) {
        const RigidMotion at = rig.camera_from_tracker(side) * perturbed(pose, error);
        return project_disc_centre(rig.lens(side), {at * target.position, at.rotation * *target.normal, 6})
            ->px;
      };
      Mat26 by;
      for (int k = 0; k < 6; ++k) {
        Vec6 step = Vec6::Zero();
        step(k) = k < 3 ? 1e-5 : 1e-2;
        by.col(k) = (image(step) - image(-step)) / (2 * step(k));
      }
      sum += by.transpose() * by / (sigma_px * sigma_px);
    }
  }
  return sum;
}

TEST(PoseInformation, IsThatOfTheExactImagesDerivatives) {
  const StereoRig rig = scene::rig();
  const std::vector<Target> targets = scene::targets_of(scene::kTable1[2]);
  for (const RigidMotion& pose : scene::motion(rig, 4)) {
    const Mat6 expected = information_by_differences(targets, pose, rig, 0.05);
    const Mat6 found = pose_information(targets, kAll, pose, rig, {}).value();
    // What distortion adds to a disc's centre is a hundredth of a pixel; its derivatives are left out.
    EXPECT_LT((found - expected).norm(), 1e-5 * expected.norm());
  }
}

TEST(PoseInformation, AddsUpOverTargetsAndCameras) {
  const StereoRig rig = scene::rig();
  const RigidMotion pose = scene::motion(rig, 1)[0];
  std::vector<Target> targets = scene::targets_of(scene::kTable1[0]);
  targets[1].covariance = 1e-4 * Mat3::Identity();
  Mat6 sum = Mat6::Zero();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    sum += pose_information(targets, {TargetMask{1} << i, TargetMask{1} << i}, pose, rig, {}).value();
  }
  const Mat6 whole = pose_information(targets, kAll, pose, rig, {}).value();
  EXPECT_LT((whole - sum).norm(), 1e-12 * whole.norm());
}

TEST(PoseInformation, BecomesThatOfPointsWhenTheMapIsAllTheDoubt) {
  // Perfect centres, a map of 0.1 mm: six points registered in space.
  const StereoRig rig = scene::rig();
  const RigidMotion pose = scene::motion(rig, 3)[1];
  AccuracyOptions options;
  options.sigma_px = 1e-4;
  options.map_sigma_mm = 0.1;
  const std::vector<Target> targets = scene::targets_of(scene::kTable1[1]);
  const PoseAccuracy accuracy = predict_pose_accuracy(targets, kAll, pose, rig, options).value();
  const Vec3 part(0, 0, 900);
  EXPECT_NEAR(error_at_point_mm(pose, accuracy.covariance, part),
              registration_error_mm(scene::kTable1[1], part, 0.1).value(), 1e-4);
  EXPECT_NEAR(error_at_point_mm(pose, accuracy.systematic, part),
              registration_error_mm(scene::kTable1[1], part, 0.1).value(), 1e-4);
}

TEST(PredictPoseAccuracy, MovesWithTheCell) {
  // The whole cell moved changes nothing but the body's own frame: the error at the part stays.
  const StereoRig rig = scene::rig();
  const RigidMotion pose = scene::motion(rig, 3)[2];
  std::vector<Target> targets = scene::targets_of(scene::kTable1[2]);
  const PoseAccuracy before = predict_pose_accuracy(targets, kAll, pose, rig, {}).value();
  const RigidMotion elsewhere{rotation_from_yaw_pitch_roll(0.5, -1, 2), {4000, 900, -7000}};
  for (Target& target : targets) {
    target.position = elsewhere * target.position;
    target.normal = elsewhere.rotation * *target.normal;
  }
  const RigidMotion moved = pose * elsewhere.inverse();
  const PoseAccuracy after = predict_pose_accuracy(targets, kAll, moved, rig, {}).value();
  const Vec3 part(0, 0, 900);
  EXPECT_NEAR(error_at_point_mm(moved, after.covariance, elsewhere * part),
              error_at_point_mm(pose, before.covariance, part), 1e-7);
}

TEST(PredictPoseAccuracy, AddsTheRigsOwnDoubtAsSystematic) {
  StereoRig rig = scene::rig();
  const RigidMotion pose = scene::motion(rig, 3)[2];
  const std::vector<Target> targets = scene::targets_of(scene::kTable1[2]);
  const PoseAccuracy before = predict_pose_accuracy(targets, kAll, pose, rig, {}).value();
  EXPECT_LT(before.systematic.norm(), 1e-15);

  // The left camera's principal point alone, by 0.2 px: the pose moves as the noise-free estimate would.
  rig.covariance_order = rig_parameter_names(rig);
  const auto count = static_cast<Eigen::Index>(rig.covariance_order.size());
  rig.covariance = MatX::Zero(count, count);
  rig.covariance(3, 3) = 0.04;
  const PoseAccuracy after = predict_pose_accuracy(targets, kAll, pose, rig, {}).value();
  EXPECT_LT((after.covariance - before.covariance - after.systematic).norm(), 1e-12);
  const double moved = error_at_point_mm(pose, after.systematic, {0, 0, 600});
  // A shift of cx by 0.2 px turns the left sight lines: some 0.2 px · z² / (b f) in depth.
  EXPECT_NEAR(moved, 0.2 * 2300 * 2300 / (1000 * 3200.0), 0.35 * moved);
}

TEST(PredictPoseAccuracy, NamesWhyThereIsNone) {
  const StereoRig rig = scene::rig();
  const RigidMotion pose = scene::motion(rig, 1)[0];
  const std::vector<Target> targets = scene::targets_of(scene::kTable1[0]);
  EXPECT_EQ(predict_pose_accuracy(targets, {0b11, 0b11}, pose, rig, {}).error(),
            AccuracyFailure::NotDetermined);
  EXPECT_EQ(predict_pose_accuracy(targets, {0, 0}, pose, rig, {}).error(), AccuracyFailure::NotDetermined);
  EXPECT_EQ(predict_pose_accuracy(targets, kAll, {pose.rotation, {0, 0, -3000}}, rig, {}).error(),
            AccuracyFailure::BehindCamera);
  AccuracyOptions strict;
  strict.max_sigma_deg = 1e-3;
  EXPECT_EQ(predict_pose_accuracy(targets, kAll, pose, rig, strict).error(), AccuracyFailure::NotDetermined);
}

TEST(CentreBound, GrowsWithBlurAndFallsWithSize) {
  const CentreBound bound = centre_bound(Sensor{}, Light{});
  EXPECT_NEAR(bound.blur_px, std::sqrt(0.55 * 0.55 + 1.0 / 12), 1e-12);
  // A disc of 10 px radius, square on: some thousandths of a pixel.
  const double sigma = std::sqrt(bound.variance_times_px(0) / 10);
  EXPECT_GT(sigma, 0.001);
  EXPECT_LT(sigma, 0.01);
  EXPECT_GT(bound.variance_times_px(rad_from_deg(55)), 2 * bound.variance_times_px(0));
  Sensor blurred;
  blurred.blur_px = 1.5;
  EXPECT_GT(centre_bound(blurred, Light{}).variance_times_px(0), bound.variance_times_px(0));
}

TEST(CentreBound, IsThatOfTheGradientSummedOverTheImage) {
  // √π ρ A² / (2 σ_b) against the sum over pixels of (∂I/∂x)² of a blurred edge round a disc.
  const double rho = 12, blur = 0.8, step = 0.05;
  double sum = 0;
  for (double x = -20; x < 20; x += step) {
    for (double y = -20; y < 20; y += step) {
      const double r = std::hypot(x, y), d = (r - rho) / blur;
      const double slope = std::exp(-0.5 * d * d) / (blur * std::sqrt(2 * std::numbers::pi));
      sum += slope * slope * x * x / (r * r + 1e-12) * step * step;
    }
  }
  CentreBound bound;
  bound.blur_px = blur;
  bound.amplitude = 1;
  bound.background_variance = 1e-4;
  EXPECT_NEAR(bound.variance_times_px(0) / rho, 1e-4 / sum, 0.005 * 1e-4 / sum);
}

}  // namespace
}  // namespace asterism
