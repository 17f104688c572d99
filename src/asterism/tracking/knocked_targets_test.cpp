// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/knocked_targets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "asterism/tracking/scene_for_tests.hpp"
#include "asterism/tracking/tracker.hpp"

namespace asterism {
namespace {

constexpr double kMap_mm = 0.01;

/// A run of a body whose targets stand off their places by `off`.
struct BodyRun {
  Body learnt = scene::body();
  std::vector<Vec3> off_mm = std::vector<Vec3>(6, Vec3::Zero());
  double sigma_px = 0.02;
  std::vector<int> hidden;  // targets that are not there

  BodyRun() {
    for (Target& target : learnt.targets) target.covariance = kMap_mm * kMap_mm * Mat3::Identity();
  }
  void move_off_map(RandomStream& random) {
    for (Vec3& off : off_mm) off += kMap_mm * Vec3(random.normal(), random.normal(), random.normal());
  }
  [[nodiscard]] std::vector<TrackedFrame> track(int frames, std::uint64_t seed) const {
    const StereoRig rig = scene::rig();
    Body there = learnt;
    for (std::size_t t = 0; t < there.targets.size(); ++t) there.targets[t].position += off_mm[t];
    Tracker tracker(rig, {learnt});
    std::vector<TrackedFrame> tracked;
    for (int frame = 0; frame < frames; ++frame) {
      RandomStream random(seed, static_cast<std::uint64_t>(frame));
      // Far apart in time: each pose stands for itself.
      StereoCentres centres{frame, 10.0 * frame, {}, {}};
      const RigidMotion at = scene::pose(random);
      for (int t = 0; t < static_cast<int>(there.targets.size()); ++t) {
        if (std::find(hidden.begin(), hidden.end(), t) != hidden.end()) continue;
        for (const Side side : {Side::Left, Side::Right}) {
          auto& list = side == Side::Left ? centres.left : centres.right;
          list.push_back(scene::centre(scene::image_of(rig, there, at, t, side), sigma_px, random));
        }
      }
      tracked.push_back(tracker.process(centres));
    }
    return tracked;
  }
  [[nodiscard]] ShapeCheck check(int frames, std::uint64_t seed) const {
    return check_shape(0, track(frames, seed), {learnt}, scene::rig(), {});
  }
};

TEST(CheckShape, NamesTheTargetThatMovedAndSaysWhereTo) {
  for (const double mm : {0.3, 1.0, 5.0}) {
    BodyRun run;
    RandomStream random(301, 0);
    run.move_off_map(random);
    run.off_mm[2] += mm * Vec3(0.6, -0.5, 0.62);
    const ShapeCheck check = run.check(30, 302);
    ASSERT_EQ(check.knocked.size(), 1u) << mm;
    const KnockedTarget& knocked = check.knocked[0];
    EXPECT_EQ(knocked.target, 2);
    EXPECT_TRUE(knocked.rivals.empty());
    EXPECT_EQ(knocked.excluded, 30u);
    const Vec3 miss = knocked.shift_mm - run.off_mm[2];
    EXPECT_LT(miss.dot(knocked.covariance.inverse() * miss), 21);  // χ² with three degrees: 1 in 10⁴
    EXPECT_LT(std::sqrt(knocked.covariance.trace()), 0.05);
  }
}

TEST(CheckShape, AccusesNobodyWhenAllStandWithinTheirMap) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    BodyRun run;
    RandomStream random(303, seed);
    run.move_off_map(random);
    EXPECT_TRUE(run.check(10, 304 + seed).knocked.empty()) << seed;
  }
}

TEST(CheckShape, StatesADoubtOfTheShiftThatHolds) {
  double sum = 0;
  constexpr int kRuns = 60;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    BodyRun run;
    RandomStream random(305, seed);
    run.move_off_map(random);
    run.off_mm[4] += Vec3(-0.5, 0.4, 0.3);
    const ShapeCheck check = run.check(4, 1000 + seed);
    ASSERT_EQ(check.knocked.size(), 1u);
    ASSERT_EQ(check.knocked[0].target, 4);
    const Vec3 miss = check.knocked[0].shift_mm - run.off_mm[4];
    sum += miss.dot(check.knocked[0].covariance.inverse() * miss) / 3;
  }
  EXPECT_NEAR(sum / kRuns, 1, 0.32);  // three standard errors of χ²₁₈₀ / 180
}

TEST(CheckShape, SeesOverTimeWhatNoFrameShowsAlone) {
  BodyRun run;
  run.sigma_px = 0.15;
  run.off_mm[1] = {0.45, 0.45, -0.3};
  const ShapeCheck check = run.check(120, 306);
  ASSERT_EQ(check.knocked.size(), 1u);
  EXPECT_EQ(check.knocked[0].target, 1);
  EXPECT_LT(check.knocked[0].excluded, 30u);  // a single frame seldom refuses it
  EXPECT_LT(check.detectable_mm[1], 0.7);
  EXPECT_GT(check.detectable_at_once_mm[1], 1.0);
}

TEST(CheckShape, SaysHowSmallAKnockIsFoundFourTimesInFive) {
  // In the direction that is hardest to see, which for targets in a plane is nearly its normal.
  constexpr int kRuns = 60;
  int found = 0;
  int found_of_a_third = 0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    BodyRun run;
    RandomStream random(307, seed);
    run.move_off_map(random);
    const double detectable = run.check(4, 2000 + seed).detectable_mm[0];
    const Vec3 unmoved = run.off_mm[0];
    run.off_mm[0] = unmoved + Vec3(0, 0, detectable);
    found += run.check(4, 2000 + seed).knocked.empty() ? 0 : 1;
    run.off_mm[0] = unmoved + Vec3(0, 0, detectable / 3);
    found_of_a_third += run.check(4, 2000 + seed).knocked.empty() ? 0 : 1;
  }
  EXPECT_GT(found, 0.6 * kRuns);
  EXPECT_LT(found_of_a_third, 0.1 * kRuns);
}

TEST(CheckShape, NamesTheRivalsWhenFourTargetsCannotTellWhichMoved) {
  // Of four targets in a plane any one, moved out of it, twists the four alike.
  BodyRun run;
  run.learnt.targets.resize(4);
  const Vec3 places[] = {{200, 200, 600}, {-220, 180, 600}, {-150, -230, 600}, {240, -160, 600}};
  for (std::size_t t = 0; t < 4; ++t) run.learnt.targets[t].position = places[t];
  run.off_mm.assign(4, Vec3::Zero());
  run.off_mm[3] = {0, 0, 0.6};
  const ShapeCheck check = run.check(20, 308);
  ASSERT_EQ(check.knocked.size(), 1u);
  EXPECT_EQ(check.knocked[0].rivals.size(), 3u);
}

TEST(CheckShape, SaysNothingOfARunThatShowsNothing) {
  BodyRun run;
  run.hidden = {0, 1, 2, 3};
  const ShapeCheck check = run.check(5, 309);
  EXPECT_TRUE(check.knocked.empty());
  EXPECT_EQ(check.misfit, 1);
}

TEST(CheckShape, LeavesATargetThatIsGoneAlone) {
  BodyRun run;
  run.hidden = {3};
  const ShapeCheck check = run.check(10, 310);
  EXPECT_TRUE(check.knocked.empty());
  EXPECT_TRUE(std::isinf(check.detectable_mm[3]));
  EXPECT_LT(check.detectable_mm[0], 1);
}

}  // namespace
}  // namespace asterism
