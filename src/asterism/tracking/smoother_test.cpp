// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/smoother.hpp"

#include <gtest/gtest.h>

#include "asterism/core/result.hpp"
#include "asterism/tracking/filter.hpp"
#include "asterism/tracking/moving_body_for_tests.hpp"

namespace asterism {
namespace {

using scene::MovingBody;
using scene::nees;

struct Recorded {
  std::vector<TrackedFrame> frames;
  std::vector<RigidMotion> truth;
};

Recorded recorded(const FilterOptions& options, std::uint64_t number, int count) {
  RandomStream random(61, number);
  MovingBody body(options, random);
  Recorded run;
  for (int frame = 0; frame < count; ++frame) {
    body.move(frame % 4 == 0 ? 0.03 : 0.015, random);
    TrackedFrame tracked;
    tracked.centres.frame = frame;
    tracked.centres.time_s = body.time_s;
    tracked.poses.push_back(frame % 7 == 3 ? BodyPose{} : body.measured(random));
    run.frames.push_back(tracked);
    run.truth.push_back(body.truth);
  }
  return run;
}

TEST(Smooth, StatesACovarianceThatHolds) {
  const FilterOptions options;
  double sum = 0;
  int count = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    const Recorded run = recorded(options, number, 60);
    const auto smoothed = smooth(run.frames, options);
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      ASSERT_EQ(smoothed[i].size(), 1u);
      if (!smoothed[i][0].estimate) continue;
      sum += nees(*smoothed[i][0].estimate, run.truth[i]) / 6;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 1.0, 0.06);
}

TEST(Smooth, IsBetterThanTheFilter) {
  FilterOptions options;
  options.rate_wander_deg_s = 2;
  options.speed_wander_mm_s = 20;
  const Recorded run = recorded(options, 100, 200);
  const auto smoothed = smooth(run.frames, options);
  PoseFilter filter(options);
  double filter_square = 0, smoother_square = 0;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const BodyPose filtered = filter.update(run.frames[i].centres.time_s, run.frames[i].poses[0]);
    if (!smoothed[i][0].estimate) continue;
    filter_square += difference(filtered.estimate->tracker_from_body, run.truth[i]).squaredNorm();
    smoother_square += difference(smoothed[i][0].estimate->tracker_from_body, run.truth[i]).squaredNorm();
  }
  EXPECT_LT(smoother_square, 0.7 * filter_square);
}

TEST(Smooth, InventsNothingWhereNothingWasMeasured) {
  const Recorded run = recorded({}, 0, 30);
  const auto smoothed = smooth(run.frames, {});
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    EXPECT_EQ(smoothed[i][0].status, run.frames[i].poses[0].status);
    EXPECT_EQ(smoothed[i][0].estimate.has_value(), run.frames[i].poses[0].estimate.has_value());
  }
}

TEST(Smooth, DoesNotReachAcrossALongGapOrAJump) {
  Recorded run = recorded({}, 1, 40);
  for (std::size_t i = 20; i < 40; ++i) run.frames[i].centres.time_s += 10;
  const auto whole = smooth(run.frames, {});
  const auto first = smooth(std::span(run.frames).first(20), {});
  for (std::size_t i = 0; i < 20; ++i) {
    if (!first[i][0].estimate) continue;
    EXPECT_EQ(whole[i][0].estimate->tracker_from_body.translation,
              first[i][0].estimate->tracker_from_body.translation);
  }
}

TEST(Smooth, NamesTheFrameWhoseTimeGoesBack) {
  Recorded run = recorded({}, 2, 10);
  run.frames[6].centres.time_s = 0;
  try {
    (void)smooth(run.frames, {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("frame 6: its time 0 s is before that of frame 5"),
              std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(smooth({}, {}).empty());
}

}  // namespace
}  // namespace asterism
