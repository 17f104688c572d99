// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/fused_filter.hpp"

#include <gtest/gtest.h>

#include "asterism/core/result.hpp"
#include "asterism/tracking/moving_body_for_tests.hpp"
#include "asterism/tracking/platform_for_tests.hpp"

namespace asterism {
namespace {

using scene::MovingBody;
using scene::nees;
using scene::SweepingPlatform;

const RigidMotion kTrackerFromBase{exp_rotation({1.0, -0.5, 2.0}), Vec3(300, 150, 2600)};

/// A run as the filter believes it to be: 20 frames and 100 readings a second of a body that wanders.
struct WatchedRun {
  std::vector<TimedPose> tracked;
  std::vector<PlatformReading> readings;
  std::vector<RigidMotion> truth;  // of each tracked pose
};
struct RunSetting {
  double seconds = 2;
  double blind_from_s = 9, blind_to_s = 9;
  double latency_s = 0;
  double correlation_s = 0;
  double jump_share = 0, jump_mm = 0;
  double slip_at_s = 9;  // from then on all readings are 20 mm aside
};

FilterOptions slow_wander() {
  FilterOptions options;
  options.rate_wander_deg_s = 30;
  options.speed_wander_mm_s = 300;
  return options;
}

WatchedRun run_of(const RunSetting& options, std::uint64_t seed) {
  RandomStream random(seed, 1);
  MovingBody body(slow_wander(), random);
  Mat6 noise = Mat6::Zero();
  noise.diagonal() << Vec3::Constant(3.6e-7), Vec3::Constant(0.034);
  const double keeps = options.correlation_s > 0 ? std::exp(-0.01 / options.correlation_s) : 0;
  Vec6 error = SweepingPlatform::draw(noise, random);
  WatchedRun run;
  for (int tick = 1; tick <= std::lround(options.seconds / 0.01); ++tick) {
    body.move(0.01, random);
    if (tick % 5 == 0) {
      const bool blind = body.time_s > options.blind_from_s && body.time_s < options.blind_to_s;
      const BodyPose pose = body.measured(random);
      run.tracked.push_back({body.time_s, blind ? BodyPose{} : pose});
      run.truth.push_back(body.truth);
    }
    error = keeps * error + std::sqrt(1 - keeps * keeps) * SweepingPlatform::draw(noise, random);
    RigidMotion read = kTrackerFromBase.inverse() * body.truth;
    if (random.uniform() < options.jump_share) read.translation.y() += options.jump_mm;
    if (body.time_s > options.slip_at_s) read.translation.x() += 20;
    run.readings.push_back({body.time_s + options.latency_s, perturbed(read, error), noise,
                            keeps > 0 ? noise : Mat6(Mat6::Zero())});
  }
  return run;
}

/// Mean NEES over six of all PREDICTED poses and of all OK ones from 0.3 s on.
struct Doubt {
  double predicted = 0, seen = 0;
};
Doubt doubt_over_runs(const RunSetting& run_options, FusedOptions options, int runs) {
  options.correlation_s = run_options.correlation_s;
  Doubt doubt;
  int predicted = 0, seen = 0;
  for (int i = 0; i < runs; ++i) {
    const WatchedRun run = run_of(run_options, 500 + static_cast<std::uint64_t>(i));
    // What the filter is told of the latency is off by as much as it is told to doubt.
    RandomStream random(77, static_cast<std::uint64_t>(i));
    options.latency_s = run_options.latency_s + options.latency_sigma_s * random.normal();
    const auto poses = fused(run.tracked, run.readings, options, slow_wander());
    for (std::size_t k = 6; k < poses.size(); ++k) {
      if (!poses[k].estimate) continue;
      const bool ok = poses[k].status == PoseStatus::Ok;
      (ok ? doubt.seen : doubt.predicted) += nees(*poses[k].estimate, run.truth[k]) / 6;
      ++(ok ? seen : predicted);
    }
  }
  doubt.predicted /= std::max(1, predicted);
  doubt.seen /= std::max(1, seen);
  return doubt;
}

TEST(FusedFilter, StatesACovarianceThatHoldsThroughAnOcclusion) {
  RunSetting run;
  run.blind_from_s = 1.0;
  run.blind_to_s = 1.55;
  run.latency_s = 0.02;
  const Doubt doubt = doubt_over_runs(run, {}, 60);
  EXPECT_NEAR(doubt.predicted, 1, 0.12);  // as frames of one run hang together, about four σ
  EXPECT_NEAR(doubt.seen, 1, 0.08);
}

TEST(FusedFilter, StatesACovarianceThatHoldsWhenTheNoiseLasts) {
  RunSetting run;
  run.blind_from_s = 1.0;
  run.blind_to_s = 1.55;
  for (const double correlation_s : {0.05, 1.0, 30.0}) {
    run.correlation_s = correlation_s;
    const Doubt doubt = doubt_over_runs(run, {}, 60);
    EXPECT_NEAR(doubt.predicted, 1, 0.2) << "correlation " << correlation_s << " s";
    EXPECT_NEAR(doubt.seen, 1, 0.1) << "correlation " << correlation_s << " s";
  }
}

TEST(FusedFilter, CarriesTheDoubtOfTheLatencyAlong) {
  RunSetting run;
  run.blind_from_s = 1.0;
  run.blind_to_s = 1.55;
  FusedOptions options;
  options.latency_sigma_s = 0.002;  // at 200 mm/s and more as much as the readings' noise
  const Doubt doubt = doubt_over_runs(run, options, 60);
  EXPECT_NEAR(doubt.predicted, 1, 0.25);
  EXPECT_NEAR(doubt.seen, 1, 0.1);
}

TEST(FusedFilter, HoldsThroughAnOcclusionWhatTheTrackerAloneLoses) {
  RunSetting run_options;
  run_options.blind_from_s = 1.0;
  run_options.blind_to_s = 1.52;
  double with = 0, without = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const WatchedRun run = run_of(run_options, seed);
    const auto fusion = fused(run.tracked, run.readings, {}, slow_wander());
    const auto alone = fused(run.tracked, {}, {}, slow_wander());
    const std::size_t last = 28;  // 1.45 s: 0.45 s after the last pose
    ASSERT_EQ(fusion[last].status, PoseStatus::Predicted);
    ASSERT_EQ(alone[last].status, PoseStatus::Predicted);
    EXPECT_LT(fusion[last].estimate->covariance.trace(), 1e-3 * alone[last].estimate->covariance.trace());
    with += difference(fusion[last].estimate->tracker_from_body, run.truth[last]).tail<3>().norm() / 20;
    without += difference(alone[last].estimate->tracker_from_body, run.truth[last]).tail<3>().norm() / 20;
  }
  EXPECT_LT(with, 0.6);  // mm; one reading alone is off by 0.3 mm on average
  EXPECT_GT(without, 20.0);
}

TEST(FusedFilter, WithoutReadingsIsThePoseFilter) {
  RunSetting run_options;
  run_options.blind_from_s = 0.8;
  run_options.blind_to_s = 1.4;
  WatchedRun run = run_of(run_options, 3);
  run.tracked[35].pose.estimate->tracker_from_body.translation.x() += 500;
  const auto fusion = fused(run.tracked, {}, {}, slow_wander());
  PoseFilter filter(slow_wander());
  for (std::size_t i = 0; i < run.tracked.size(); ++i) {
    const BodyPose alone = filter.update(run.tracked[i].time_s, run.tracked[i].pose);
    ASSERT_EQ(fusion[i].status, alone.status) << i;
    if (!alone.estimate) continue;
    EXPECT_LT(difference(fusion[i].estimate->tracker_from_body, alone.estimate->tracker_from_body).norm(),
              1e-9);
    EXPECT_TRUE(fusion[i].estimate->covariance.isApprox(alone.estimate->covariance, 1e-9));
  }
}

TEST(FusedFilter, NeverShowsACarriedPoseAsMeasuredAndLosesItWhenNobodySpeaks) {
  RunSetting run_options;
  run_options.seconds = 3;
  run_options.blind_from_s = 1.0;
  WatchedRun run = run_of(run_options, 4);
  std::erase_if(run.readings, [](const PlatformReading& reading) { return reading.time_s > 2.0; });
  const auto poses = fused(run.tracked, run.readings, {}, slow_wander());
  for (std::size_t i = 20; i < poses.size(); ++i) {
    const double time_s = run.tracked[i].time_s;
    // Readings carry it on to 2.0 s, and it coasts 0.5 s from there.
    EXPECT_EQ(poses[i].status, time_s < 2.52 ? PoseStatus::Predicted : PoseStatus::Lost) << time_s;
    EXPECT_EQ(poses[i].targets, 0);
  }
}

TEST(FusedFilter, GivesTheSameBitsInWhateverOrderMeasurementsArrive) {
  RunSetting run_options;
  run_options.blind_from_s = 1.0;
  run_options.blind_to_s = 1.3;
  const WatchedRun run = run_of(run_options, 5);
  FusedFilter in_order({}, slow_wander()), late_frames({}, slow_wander()), late_readings({}, slow_wander());
  for (std::size_t i = 0; i < run.tracked.size(); ++i) {
    const auto& [time_s, pose] = run.tracked[i];
    for (std::size_t k = 5 * i; k < 5 * i + 5; ++k) {
      static_cast<void>(in_order.update_read_out(run.readings[k]));
      static_cast<void>(late_frames.update_read_out(run.readings[k]));
    }
    static_cast<void>(in_order.update_tracker(time_s, pose));
    if (i >= 3)
      static_cast<void>(late_frames.update_tracker(run.tracked[i - 3].time_s, run.tracked[i - 3].pose));
    static_cast<void>(late_readings.update_tracker(time_s, pose));
    for (std::size_t k = 5 * i + 5; i >= 3 && k-- > 5 * i;) {  // backwards
      static_cast<void>(late_readings.update_read_out(run.readings[k - 15]));
    }
  }
  for (std::size_t i = run.tracked.size() - 3; i < run.tracked.size(); ++i) {
    static_cast<void>(late_frames.update_tracker(run.tracked[i].time_s, run.tracked[i].pose));
    for (std::size_t k = 5 * i; k < 5 * i + 5; ++k) {
      static_cast<void>(late_readings.update_read_out(run.readings[k]));
    }
  }
  const auto expected = in_order.predict(2.1);
  ASSERT_TRUE(expected);
  for (const FusedFilter* other : {&late_frames, &late_readings}) {
    const auto got = other->predict(2.1);
    ASSERT_TRUE(got);
    EXPECT_EQ(got->tracker_from_body.translation, expected->tracker_from_body.translation);
    EXPECT_EQ(got->tracker_from_body.rotation.coeffs(), expected->tracker_from_body.rotation.coeffs());
    EXPECT_EQ(got->covariance, expected->covariance);
  }
}

TEST(FusedFilter, RefusesJumps) {
  RunSetting run_options;
  run_options.jump_share = 0.1;
  run_options.jump_mm = 8;
  run_options.blind_from_s = 1.0;
  run_options.blind_to_s = 1.55;
  const WatchedRun run = run_of(run_options, 6);
  FusedFilter filter({}, slow_wander());
  int refused = 0, used = 0;
  for (std::size_t i = 0; i < run.tracked.size(); ++i) {
    for (std::size_t k = 5 * i; k < 5 * i + 5; ++k) {
      const ReadingUse use = filter.update_read_out(run.readings[k]);
      refused += use == ReadingUse::Refused ? 1 : 0;
      used += use == ReadingUse::Used ? 1 : 0;
    }
    static_cast<void>(filter.update_tracker(run.tracked[i].time_s, run.tracked[i].pose));
  }
  EXPECT_NEAR(refused, 0.1 * (refused + used), 12);  // three σ of the count
  EXPECT_GT(refused, 5);
  EXPECT_LT(doubt_over_runs(run_options, {}, 40).predicted, 1.2);
}

TEST(FusedFilter, LearnsTheFrameAnewWhenTheReadOutSlips) {
  RunSetting run_options;
  run_options.slip_at_s = 1.0;
  const WatchedRun run = run_of(run_options, 7);
  FusedFilter filter({}, slow_wander());
  int slipped = 0;
  for (std::size_t i = 0; i < run.tracked.size(); ++i) {
    for (std::size_t k = 5 * i; k < 5 * i + 5; ++k) {
      slipped += filter.update_read_out(run.readings[k]) == ReadingUse::Slipped ? 1 : 0;
    }
    const BodyPose pose = filter.update_tracker(run.tracked[i].time_s, run.tracked[i].pose);
    EXPECT_EQ(pose.status, PoseStatus::Ok);
    EXPECT_LT(difference(pose.estimate->tracker_from_body, run.truth[i]).tail<3>().norm(), 0.3);
  }
  EXPECT_EQ(slipped, 1);
  const RigidMotion moved_base = kTrackerFromBase * RigidMotion{Quaternion::Identity(), Vec3(-20, 0, 0)};
  const auto base = filter.tracker_from_base();
  ASSERT_TRUE(base);
  EXPECT_LT(nees(*base, moved_base), 30);  // χ² with six degrees: 22 at 0.999
}

TEST(FusedFilter, DoesNotDependOnWhereTheBaseIs) {
  RunSetting run_options;
  run_options.blind_from_s = 1.0;
  run_options.blind_to_s = 1.55;
  const WatchedRun run = run_of(run_options, 8);
  const RigidMotion far_from_base{exp_rotation({0.3, -2, 1}), Vec3(1500, -900, 700)};
  Mat6 turn = Mat6::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = far_from_base.rotation.toRotationMatrix();
  std::vector<PlatformReading> readings = run.readings;
  for (PlatformReading& reading : readings) {
    reading.base_from_body = far_from_base * reading.base_from_body;
    reading.covariance = turn * reading.covariance * turn.transpose();
  }
  const auto here = fused(run.tracked, run.readings, {}, slow_wander());
  const auto there = fused(run.tracked, readings, {}, slow_wander());
  for (std::size_t i = 0; i < here.size(); ++i) {
    const Vec6 off = difference(here[i].estimate->tracker_from_body, there[i].estimate->tracker_from_body);
    EXPECT_LT(off.tail<3>().norm(), 0.01);  // the steps are linear ones: a twentieth of the noise
    EXPECT_LT(off.head<3>().norm(), 1e-5);
  }
}

TEST(FusedFilter, UsesAKnownFrameFromTheFirstReading) {
  const WatchedRun run = run_of({}, 9);
  TimeOffset known;
  known.tracker_from_base = kTrackerFromBase;
  known.covariance = 1e-8 * Mat6::Identity();
  FusedFilter filter({}, slow_wander(), known);
  EXPECT_EQ(filter.update_read_out(run.readings[0]), ReadingUse::Waits);
  static_cast<void>(filter.update_tracker(run.tracked[0].time_s, run.tracked[0].pose));
  static_cast<void>(filter.update_tracker(run.tracked[1].time_s, run.tracked[1].pose));
  EXPECT_EQ(filter.update_read_out(run.readings[10]), ReadingUse::Used);
  FusedFilter unknowing({}, slow_wander());
  static_cast<void>(unknowing.update_tracker(run.tracked[0].time_s, run.tracked[0].pose));
  EXPECT_EQ(unknowing.update_read_out(run.readings[4]), ReadingUse::Waits);
  static_cast<void>(unknowing.update_tracker(run.tracked[1].time_s, run.tracked[1].pose));
  EXPECT_EQ(unknowing.update_read_out(run.readings[10]), ReadingUse::Learnt);
}

TEST(FusedFilter, NeverAveragesASystematicErrorAway) {
  WatchedRun run = run_of({}, 10);
  const Mat6 systematic = 0.5 * run.tracked[0].pose.estimate->covariance;
  for (TimedPose& tracked : run.tracked) tracked.pose.estimate->systematic = systematic;
  const auto poses = fused(run.tracked, run.readings, {}, slow_wander());
  EXPECT_GE(poses.back().estimate->covariance(5, 5), systematic(5, 5));
  EXPECT_TRUE(poses.back().estimate->systematic.isApprox(systematic));
}

TEST(FusedFilter, RefusesWhatComesTooLate) {
  const WatchedRun run = run_of({}, 11);
  FusedFilter filter({}, slow_wander());
  for (const auto& [time_s, pose] : run.tracked) static_cast<void>(filter.update_tracker(time_s, pose));
  EXPECT_EQ(filter.update_read_out(run.readings[20]), ReadingUse::TooLate);
  EXPECT_NE(filter.update_read_out(run.readings[180]), ReadingUse::TooLate);
  try {
    static_cast<void>(filter.update_tracker(0.2, {}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("let memory_s = 0.5 be longer"), std::string::npos);
  }
}

}  // namespace
}  // namespace asterism
