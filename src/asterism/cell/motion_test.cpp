// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/motion.hpp"

#include <gtest/gtest.h>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

RigidMotion random_motion(RandomStream& random) {
  const Vec3 turn{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-1, 1)};
  const Vec3 shift{random.uniform(-500, 500), random.uniform(-500, 500), random.uniform(1500, 2500)};
  return {exp_rotation(turn), shift};
}

KeyedMotion random_keys(std::uint64_t seed, int count) {
  RandomStream random(seed, 0);
  KeyedMotion motion;
  double time_s = 0;
  for (int i = 0; i < count; ++i) {
    motion.keys.push_back({time_s, random_motion(random)});
    time_s += random.uniform(0.3, 1.5);
  }
  return motion;
}

TEST(KeyedMotion, MeetsEachKeyAndStandsStillBeyondTheEnds) {
  const KeyedMotion motion = random_keys(3, 6);
  for (const KeyPose& key : motion.keys) {
    EXPECT_LT(difference(pose_at(motion, key.time_s), key.tracker_from_body).norm(), 1e-9);
  }
  EXPECT_LT(difference(pose_at(motion, -5), motion.keys.front().tracker_from_body).norm(), 1e-12);
  EXPECT_LT(difference(pose_at(motion, 100), motion.keys.back().tracker_from_body).norm(), 1e-12);
}

TEST(KeyedMotion, HasNoJumpInVelocityAtAKey) {
  const KeyedMotion motion = random_keys(4, 6);
  constexpr double kStep = 1e-6;
  for (std::size_t i = 1; i + 1 < motion.keys.size(); ++i) {
    const double t = motion.keys[i].time_s;
    const Vec6 before = difference(pose_at(motion, t), pose_at(motion, t - kStep)) / kStep;
    const Vec6 after = difference(pose_at(motion, t + kStep), pose_at(motion, t)) / kStep;
    EXPECT_LT((after - before).head<3>().norm(), 1e-4) << "key " << i;  // rad/s; rounding of 1e-10/1e-6
    EXPECT_LT((after - before).tail<3>().norm(), 1e-1) << "key " << i;  // mm/s of about 1000
  }
}

TEST(KeyedMotion, KeepsAConstantTwistOfEvenlySpacedKeys) {
  KeyedMotion motion;
  const Vec3 axis(0.3, -0.2, 0.5);
  for (int i = 0; i < 5; ++i)
    motion.keys.push_back({0.5 * i, {exp_rotation(0.5 * i * axis), Vec3(100.0 * i, 0, 2000)}});
  const RigidMotion mid = pose_at(motion, 0.8);
  EXPECT_LT(rotation_angle(mid.rotation, exp_rotation(0.8 * axis)), 1e-12);
  EXPECT_NEAR(mid.translation.x(), 160.0, 1e-9);
}

TEST(KeyedMotion, MovesWithTheWholeCell) {
  RandomStream random(9, 0);
  const RigidMotion moved = random_motion(random);
  const KeyedMotion motion = random_keys(5, 5);
  KeyedMotion elsewhere = motion;
  for (KeyPose& key : elsewhere.keys) key.tracker_from_body = moved * key.tracker_from_body;
  for (const double t : {0.1, 0.77, 1.9, 2.6}) {
    EXPECT_LT(difference(pose_at(elsewhere, t), moved * pose_at(motion, t)).norm(), 1e-8);
  }
}

TEST(Sweep, TurnsAboutItsPivotByTheStatedAngles) {
  Sweep sweep;
  sweep.tracker_from_rest = {exp_rotation({0.1, 2, 0.3}), {10, 20, 2000}};
  sweep.pivot_mm = {0, 0, 600};
  sweep.yaw = {0.2, 0.25, 0};
  sweep.roll = {0.1, 0.25, 0};
  const RigidMotion quarter = pose_at(sweep, 1.0);  // both at their peak
  EXPECT_LT((quarter * sweep.pivot_mm - sweep.tracker_from_rest * sweep.pivot_mm).norm(), 1e-9);
  const Quaternion turn = sweep.tracker_from_rest.rotation.conjugate() * quarter.rotation;
  EXPECT_LT(rotation_angle(turn, rotation_from_yaw_pitch_roll(0.2, 0, 0.1)), 1e-12);
  EXPECT_LT(difference(pose_at(sweep, 0), sweep.tracker_from_rest).norm(), 1e-9);
}

TEST(Sweep, TurnsInTheOrderItIsTold) {
  Sweep sweep;
  sweep.order = TurnOrder::RollPitchYaw;
  sweep.yaw = {0.3, 0, 1};
  sweep.pitch = {0.2, 0, 1};
  sweep.roll = {0.1, 0, 1};
  const double peak = std::sin(1.0);
  const Quaternion expected =
      exp_rotation({0.1 * peak, 0, 0}) * exp_rotation({0, 0.2 * peak, 0}) * exp_rotation({0, 0, 0.3 * peak});
  EXPECT_LT(rotation_angle(pose_at(sweep, 0).rotation, expected), 1e-12);
}

TEST(Sweep, IsAtRestOutsideItsTime) {
  Sweep sweep;
  sweep.tracker_from_rest = {exp_rotation({0, 1, 0}), {0, 0, 2000}};
  sweep.roll = {0.2, 0.5, 0};
  sweep.from_s = 2;
  sweep.to_s = 4;
  for (const double t : {-1.0, 1.5, 4.5}) {
    EXPECT_EQ(difference(pose_at(sweep, t), sweep.tracker_from_rest).norm(), 0) << t;
  }
  EXPECT_GT(difference(pose_at(sweep, 2.5), sweep.tracker_from_rest).norm(), 0.1);
}

TEST(PosesBetween, TakesTheFirstAndTheLastMoment) {
  Sweep sweep;
  sweep.x = {100, 0.25, 0};
  const auto poses = poses_between(sweep, 1, 3, 5);
  ASSERT_EQ(poses.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    EXPECT_LT(difference(poses[static_cast<std::size_t>(i)], pose_at(sweep, 1 + 0.5 * i)).norm(), 1e-12);
  }
  EXPECT_EQ(poses_between(sweep, 1, 3, 1).at(0).translation.x(), 100);
}

}  // namespace
}  // namespace asterism
