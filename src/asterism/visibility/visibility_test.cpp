// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/visibility.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/camera/disc_image.hpp"
#include "asterism/core/result.hpp"
#include "asterism/visibility/scene_for_tests.hpp"

namespace asterism {
namespace {

/// Straight ahead of a pair of parallel cameras, facing them.
Target facing(const Vec3& at) {
  Target target;
  target.position = at;
  target.normal = -Vec3::UnitZ();
  target.diameter_mm = 12;
  return target;
}

StereoRig parallel() {
  StereoRig rig = rig_of(CameraPair{});
  rig.right_from_left = {Quaternion::Identity(), {-1000, 0, 0}};
  return rig;
}

TargetSight sight_of(const std::vector<Target>& targets, Side side = Side::Left,
                     const std::optional<WorkingVolume>& volume = {}, const VisibilityOptions& options = {}) {
  return look_at(targets, {}, parallel(), side, volume, options).front();
}

TEST(LookAt, SeesWhatStandsSquareOn) {
  const TargetSight sight = sight_of({facing({0, 0, 2000})});
  EXPECT_FALSE(sight.fails.has_value());
  EXPECT_NEAR(sight.px.x(), 1023.5, 1e-9);
  EXPECT_NEAR(sight.semi_major_px, 3200 * 6 / 2000.0, 1e-9);
  EXPECT_NEAR(sight.semi_minor_px, sight.semi_major_px, 1e-9);
  EXPECT_NEAR(sight.incidence_rad, 0, 1e-7);
}

TEST(LookAt, NamesTheFirstConditionThatFails) {
  EXPECT_EQ(sight_of({facing({0, 0, -2000})}).fails, SightFailure::BehindCamera);
  EXPECT_EQ(sight_of({facing({0, 0, 6000})}, Side::Left, WorkingVolume{}).fails, SightFailure::OutsideVolume);
  EXPECT_EQ(sight_of({facing({800, 0, 2000})}).fails, SightFailure::OutsideImage);
  EXPECT_EQ(sight_of({facing({-200, 0, 2000})}, Side::Right).fails, SightFailure::OutsideImage);
  EXPECT_EQ(sight_of({facing({0, 0, 12000})}).fails, SightFailure::TooSmall);
  EXPECT_EQ(sight_of({facing({0, 0, 2000}), facing({12, 0, 2000})}).fails, SightFailure::TooClose);
  Target turned = facing({0, 0, 2000});
  turned.normal = exp_rotation({rad_from_deg(61), 0, 0}) * *turned.normal;
  EXPECT_EQ(sight_of({turned}).fails, SightFailure::TooOblique);
  turned.normal = Vec3::UnitZ();
  EXPECT_EQ(sight_of({turned}).fails, SightFailure::TooOblique);
}

TEST(LookAt, HoldsEachLimitExactly) {
  // The image's edge: the disc of 9.6 px plus the margin of 5 px within 0 … 2047.
  const double edge = (2047 - 5 - 9.6 - 1023.5) / 3200 * 2000;
  EXPECT_FALSE(sight_of({facing({edge - 1, 0, 2000})}).fails.has_value());
  EXPECT_EQ(sight_of({facing({edge + 1, 0, 2000})}).fails, SightFailure::OutsideImage);
  Target turned = facing({0, 0, 2000});
  turned.normal = exp_rotation({rad_from_deg(59.9), 0, 0}) * Vec3(-Vec3::UnitZ());
  EXPECT_FALSE(sight_of({turned}).fails.has_value());
  // Diameter 4 px at 9600 mm.
  EXPECT_FALSE(sight_of({facing({0, 0, 9590})}).fails.has_value());
  EXPECT_EQ(sight_of({facing({0, 0, 9610})}).fails, SightFailure::TooSmall);
  // Two discs of 9.6 px and the guard of 3 px: 22.2 px, 13.875 mm.
  EXPECT_FALSE(sight_of({facing({0, 0, 2000}), facing({13.9, 0, 2000})}).fails.has_value());
  EXPECT_EQ(sight_of({facing({0, 0, 2000}), facing({13.8, 0, 2000})}).fails, SightFailure::TooClose);
}

TEST(LookAt, LetsATargetThatFacesAwayDisturbNobody) {
  Target away = facing({5, 0, 2000});
  away.normal = Vec3::UnitZ();
  EXPECT_FALSE(sight_of({facing({0, 0, 2000}), away}).fails.has_value());
}

TEST(LookAt, TakesATargetOfUnknownNormalAndSizeForSeenSquareOnAndLargeEnough) {
  Target bare;
  bare.position = {0, 0, 8000};
  const TargetSight sight = sight_of({bare});
  EXPECT_FALSE(sight.fails.has_value());
  EXPECT_EQ(sight.semi_major_px, 0);
}

TEST(LookAt, GivesTheWayToTheNextImage) {
  const TargetSight sight = sight_of({facing({0, 0, 2000}), facing({100, 0, 2000}), facing({0, -50, 2000})});
  ASSERT_EQ(sight.nearest, 2U);
  EXPECT_NEAR(sight.clearance_px, 80 - 2 * 9.6, 0.1);
  EXPECT_TRUE(std::isinf(sight_of({facing({0, 0, 2000})}).clearance_px));
}

TEST(LookAt, AgreesWithTheExactImage) {
  const StereoRig rig = scene::rig();
  for (const RigidMotion& pose : scene::motion(rig, 7)) {
    const std::vector<Target> targets = scene::targets_of(scene::kTable1[1]);
    for (const Side side : {Side::Left, Side::Right}) {
      const auto sights = look_at(targets, pose, rig, side, {}, {});
      for (std::size_t i = 0; i < targets.size(); ++i) {
        const RigidMotion camera_from_body = rig.camera_from_tracker(side) * pose;
        const Vec3 in_camera = camera_from_body * targets[i].position;
        EXPECT_LT((sights[i].px - project(rig.lens(side), in_camera)->px).norm(), 1e-9);
        const Vec3 normal = camera_from_body.rotation * *targets[i].normal;
        EXPECT_NEAR(sights[i].incidence_rad, std::acos(-normal.dot(in_camera.normalized())), 1e-9);
        const Ellipse exact = image_of_disc(rig.lens(side), {in_camera, normal, 6}).value();
        EXPECT_NEAR(sights[i].semi_major_px, exact.semi_major, 0.05 * exact.semi_major);
        EXPECT_NEAR(sights[i].semi_minor_px, exact.semi_minor, 0.05 * exact.semi_minor);
      }
    }
  }
}

TEST(VisibleTargets, SaysOfEachPoseWhatLookAtSays) {
  const StereoRig rig = scene::rig();
  const std::vector<RigidMotion> poses = scene::motion(rig, 41);  // the last four lanes are not full
  std::vector<Target> targets = scene::targets_of(scene::kTable1[0]);
  const std::vector<Target> more = scene::targets_of(scene::kTable9[4]);
  targets.insert(targets.end(), more.begin(), more.end());
  VisibilityOptions options;
  options.max_incidence_deg = 40;
  const WorkingVolume volume{1900, 2500, 1000, 900, 1100, 1000};
  const MotionVisibility visibility = visible_targets(targets, poses, rig, volume, options);
  const SightFailureCounts counts = count_sight_failures(targets, seen_motion(poses, rig), volume, options);
  ASSERT_EQ(visibility.poses(), poses.size());
  SightFailureCounts expected(targets.size());
  std::size_t seen = 0;
  for (std::size_t pose = 0; pose < poses.size(); ++pose) {
    for (const Side side : {Side::Left, Side::Right}) {
      const auto s = static_cast<std::size_t>(side);
      const auto sights = look_at(targets, poses[pose], rig, side, volume, options);
      for (std::size_t i = 0; i < targets.size(); ++i) {
        EXPECT_EQ((visibility.seen[pose][s] >> i & 1U) != 0, !sights[i].fails.has_value());
        if (sights[i].fails) ++expected[i][s][static_cast<std::size_t>(*sights[i].fails)];
        seen += sights[i].fails ? 0 : 1;
      }
    }
  }
  EXPECT_EQ(counts, expected);
  EXPECT_GT(seen, 100U);  // both happen
  EXPECT_LT(seen, poses.size() * 2 * targets.size() - 100);
}

TEST(VisibleTargets, DoesNotDependOnWhereTheCellStands) {
  const StereoRig rig = scene::rig();
  std::vector<RigidMotion> poses = scene::motion(rig, 30);
  std::vector<Target> targets = scene::targets_of(scene::kTable1[2]);
  VisibilityOptions options;
  options.max_incidence_deg = 42;
  const auto before = visible_targets(targets, poses, rig, WorkingVolume{}, options);
  const RigidMotion elsewhere{rotation_from_yaw_pitch_roll(1, 0.4, -2), {3000, -800, 12000}};
  for (Target& target : targets) {
    target.position = elsewhere * target.position;
    target.normal = elsewhere.rotation * *target.normal;
  }
  for (RigidMotion& pose : poses) pose = pose * elsewhere.inverse();
  EXPECT_EQ(visible_targets(targets, poses, rig, WorkingVolume{}, options).seen, before.seen);
}

TEST(VisibleTargets, RefusesMoreThanSixtyFour) {
  const std::vector<Target> many(65, facing({0, 0, 2000}));
  EXPECT_THROW(static_cast<void>(visible_targets(many, std::vector<RigidMotion>(1), parallel(), {}, {})),
               ContractViolation);
}

TEST(Common, KeepsWhatBothTablesSee) {
  const MotionVisibility a{{{0b1101, 0b0111}}}, b{{{0b1011, 0b0110}}};
  const MotionVisibility joined = common(a, b);
  EXPECT_EQ(joined.seen[0][0], 0b1001U);
  EXPECT_EQ(joined.seen[0][1], 0b0110U);
  EXPECT_EQ(joined.both(0), 0U);
}

}  // namespace
}  // namespace asterism
