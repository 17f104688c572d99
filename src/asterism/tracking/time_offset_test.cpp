// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/time_offset.hpp"

#include <gtest/gtest.h>

#include "asterism/tracking/platform_for_tests.hpp"

namespace asterism {
namespace {

using scene::SweepingPlatform;

Result<TimeOffset, OffsetFailure> offset_of(const SweepingPlatform& platform, std::uint64_t seed = 1,
                                            TimeOffsetOptions options = {}) {
  options.correlation_s = platform.correlation_s;
  return estimate_time_offset(platform.tracked(seed), platform.readings(seed), options);
}

void take_noise_away(SweepingPlatform& platform) {
  platform.pose_noise *= 1e-16;
  platform.reading_noise *= 1e-16;
}

/// How the errors of many runs compare with the covariances stated: 1 where they hold.
struct Doubt {
  double offset = 0, frame = 0, within_95 = 0;
};
Doubt doubt_over_runs(const SweepingPlatform& platform, int runs) {
  Doubt doubt;
  for (int run = 0; run < runs; ++run) {
    TimeOffsetOptions options;
    options.max_offset_s = 0.06;  // a short search: the runs are many
    const auto offset = offset_of(platform, 100 + static_cast<std::uint64_t>(run), options);
    EXPECT_TRUE(offset);
    if (!offset) continue;
    const double off = (offset->latency_s - platform.latency_s) / offset->sigma_s;
    const Vec6 error = difference(offset->tracker_from_base, platform.tracker_from_base);
    doubt.offset += off * off / runs;
    doubt.within_95 += std::abs(off) < 1.96 ? 1.0 / runs : 0;
    doubt.frame += error.dot(*solve_positive(offset->covariance, error)) / 6 / runs;
  }
  return doubt;
}

TEST(TimeOffset, IsExactWithoutNoise) {
  SweepingPlatform platform;
  take_noise_away(platform);
  platform.frame_rate_hz = 50;
  for (const double latency_s : {0.0, 0.0312, -0.2, 0.4}) {
    platform.latency_s = latency_s;
    const auto offset = offset_of(platform);
    ASSERT_TRUE(offset);
    EXPECT_NEAR(offset->latency_s, latency_s, 1e-6);
    // The cubic between frames 20 ms apart is off by 1e-5 mm.
    EXPECT_LT((offset->tracker_from_base.translation - platform.tracker_from_base.translation).norm(), 1e-4);
    EXPECT_LT(rotation_angle(offset->tracker_from_base.rotation, platform.tracker_from_base.rotation), 1e-7);
  }
}

TEST(TimeOffset, IsKnownToLessThanAMillisecondAndItsSigmaHolds) {
  const SweepingPlatform platform;
  const auto offset = offset_of(platform);
  ASSERT_TRUE(offset);
  EXPECT_LT(offset->sigma_s, 1e-3);
  EXPECT_GT(offset->readings, 500);
  const Doubt doubt = doubt_over_runs(platform, 120);
  EXPECT_NEAR(doubt.offset, 1, 0.39);  // three σ of the mean of 120 χ² with one degree
  EXPECT_NEAR(doubt.within_95, 0.95, 0.06);
  EXPECT_NEAR(doubt.frame, 1, 0.16);  // three σ of the mean of 120 χ² with six degrees, over six
}

TEST(TimeOffset, StatesAnHonestSigmaWhenTheReadOutsNoiseLasts) {
  SweepingPlatform platform;
  platform.correlation_s = 0.3;
  const auto white = offset_of(SweepingPlatform{});
  const auto lasting = offset_of(platform);
  ASSERT_TRUE(white && lasting);
  EXPECT_GT(lasting->sigma_s, 2 * white->sigma_s);
  const Doubt doubt = doubt_over_runs(platform, 60);
  EXPECT_NEAR(doubt.offset, 1, 0.55);  // three σ again
  EXPECT_NEAR(doubt.frame, 1, 0.25);   // the process is of few correlation times
}

TEST(TimeOffset, StatesAnHonestSigmaWhenTheTrackerIsTheNoisierOne) {
  SweepingPlatform platform;
  platform.pose_noise *= 25;
  platform.reading_noise *= 0.01;
  const Doubt doubt = doubt_over_runs(platform, 60);
  EXPECT_NEAR(doubt.offset, 1, 0.55);
  EXPECT_NEAR(doubt.frame, 1, 0.23);
}

TEST(TimeOffset, RefusesJumps) {
  SweepingPlatform platform;
  platform.jump_share = 0.2;
  platform.jump_mm = 5;
  const auto offset = offset_of(platform);
  const auto without = offset_of(SweepingPlatform{});
  ASSERT_TRUE(offset && without);
  EXPECT_NEAR(offset->refused, 0.2 * (offset->readings + offset->refused), 40);  // σ of the count is 10
  EXPECT_LT(std::abs(offset->latency_s - platform.latency_s), 4 * offset->sigma_s);
  EXPECT_LT(offset->sigma_s, 1.3 * without->sigma_s);
  EXPECT_NEAR(offset->misfit, 1, 0.1);
}

TEST(TimeOffset, DoesNotDependOnWhereTheBaseIs) {
  SweepingPlatform platform;
  const auto here = offset_of(platform);
  const RigidMotion base_from_far{exp_rotation({0.3, -2, 1}), Vec3(4000, -1500, 900)};
  std::vector<PlatformReading> readings = platform.readings(1);
  const Mat3 turn = base_from_far.rotation.conjugate().toRotationMatrix();
  Mat6 turn6 = Mat6::Zero();
  turn6.topLeftCorner<3, 3>() = turn6.bottomRightCorner<3, 3>() = turn;
  for (PlatformReading& reading : readings) {
    reading.base_from_body = base_from_far.inverse() * reading.base_from_body;
    reading.covariance = turn6 * reading.covariance * turn6.transpose();
  }
  const auto there = estimate_time_offset(platform.tracked(1), readings, {});
  ASSERT_TRUE(here && there);
  EXPECT_NEAR(there->latency_s, here->latency_s, 1e-8);
  EXPECT_NEAR(there->sigma_s, here->sigma_s, 1e-8);
  const RigidMotion back = there->tracker_from_base * base_from_far.inverse();
  EXPECT_LT((back.translation - here->tracker_from_base.translation).norm(), 1e-4);
}

TEST(TimeOffset, SaysWhyItCannotBeTold) {
  SweepingPlatform platform;
  EXPECT_EQ(estimate_time_offset({}, platform.readings(1), {}).error(), OffsetFailure::TooFew);
  EXPECT_EQ(estimate_time_offset(platform.tracked(1), {}, {}).error(), OffsetFailure::TooFew);

  platform.latency_s = 0.7;  // beyond 0.5
  EXPECT_EQ(offset_of(platform).error(), OffsetFailure::BeyondSearch);

  platform.latency_s = 0.03;
  platform.motion.yaw.amplitude = platform.motion.pitch.amplitude = 0;
  platform.motion.roll.frequency_hz = 2.5;  // the same again after 0.4 s
  platform.frame_rate_hz = 50;
  EXPECT_EQ(offset_of(platform).error(), OffsetFailure::Periodic);

  platform.motion.roll.amplitude = 0;
  EXPECT_EQ(offset_of(platform).error(), OffsetFailure::NotMoving);
  EXPECT_EQ(text_of(OffsetFailure::NotMoving),
            "the platform does not move enough while both speak for its latency to be told");
  take_noise_away(platform);
  EXPECT_EQ(offset_of(platform).error(), OffsetFailure::NotMoving);
}

TEST(TimeOffset, LeavesOutWhatTheTrackerDidNotMeasure) {
  const SweepingPlatform platform;
  std::vector<TimedPose> tracked = platform.tracked(1);
  for (std::size_t i = 50; i < 60; ++i) tracked[i].pose = {};
  const auto offset = estimate_time_offset(tracked, platform.readings(1), {});
  ASSERT_TRUE(offset);
  EXPECT_LT(std::abs(offset->latency_s - platform.latency_s), 4 * offset->sigma_s);
  EXPECT_LT(offset->readings, offset_of(platform)->readings - 40);
}

TEST(TimeOffset, IsTheSameToTheLastBitEachTime) {
  const auto once = offset_of(SweepingPlatform{}), again = offset_of(SweepingPlatform{});
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->latency_s, again->latency_s);
  EXPECT_EQ(once->sigma_s, again->sigma_s);
}

}  // namespace
}  // namespace asterism
