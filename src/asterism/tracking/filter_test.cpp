// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/tracking/moving_body_for_tests.hpp"

namespace asterism {
namespace {

using scene::MovingBody;
using scene::nees;

TEST(PoseFilter, StatesACovarianceThatHoldsOnMotionWithNoise) {
  const FilterOptions options;
  double sum = 0;
  int count = 0;
  for (std::uint64_t run = 0; run < 40; ++run) {
    RandomStream random(51, run);
    MovingBody body(options, random);
    PoseFilter filter(options);
    for (int frame = 0; frame < 60; ++frame) {
      body.move(frame % 3 == 0 ? 0.05 : 0.02, random);  // irregular times
      const BodyPose filtered = filter.update(body.time_s, body.measured(random));
      ASSERT_TRUE(filtered.estimate);
      if (frame < 5) continue;
      sum += nees(*filtered.estimate, body.truth) / 6;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 1.0, 0.06);
}

TEST(PoseFilter, IsBetterThanTheRawPose) {
  FilterOptions options;
  options.rate_wander_deg_s = 0.3;
  options.speed_wander_mm_s = 3;
  double raw_square = 0, filtered_square = 0;
  RandomStream random(52, 0);
  MovingBody body(options, random);
  PoseFilter filter(options);
  for (int frame = 0; frame < 300; ++frame) {
    body.move(0.01, random);
    const BodyPose raw = body.measured(random);
    const BodyPose filtered = filter.update(body.time_s, raw);
    raw_square += difference(raw.estimate->tracker_from_body, body.truth).tail<3>().squaredNorm();
    filtered_square += difference(filtered.estimate->tracker_from_body, body.truth).tail<3>().squaredNorm();
  }
  EXPECT_LT(filtered_square, 0.5 * raw_square);
}

TEST(PoseFilter, CoastsWithGrowingHonestDoubtThenIsLost) {
  FilterOptions options;
  options.coast_max_s = 0.3;
  double sum = 0;
  for (std::uint64_t run = 0; run < 200; ++run) {
    RandomStream random(53, run);
    MovingBody body(options, random);
    PoseFilter filter(options);
    for (int frame = 0; frame < 20; ++frame) {
      body.move(0.02, random);
      ASSERT_EQ(filter.update(body.time_s, body.measured(random)).status, PoseStatus::Ok);
    }
    double last = 0;
    for (int frame = 0; frame < 14; ++frame) {
      body.move(0.02, random);
      const BodyPose predicted = filter.update(body.time_s, BodyPose{});
      ASSERT_EQ(predicted.status, PoseStatus::Predicted);
      EXPECT_GT(predicted.estimate->covariance.trace(), last);
      last = predicted.estimate->covariance.trace();
      if (frame == 13) sum += nees(*predicted.estimate, body.truth) / 6 / 200;
    }
    body.move(0.03, random);
    const BodyPose lost = filter.update(body.time_s, BodyPose{});
    EXPECT_EQ(lost.status, PoseStatus::Lost);
    EXPECT_FALSE(lost.estimate);
  }
  EXPECT_NEAR(sum, 1.0, 0.15);
}

TEST(PoseFilter, LeavesOutOnePoseThatDoesNotFitAndStartsAgainAtTheSecond) {
  const FilterOptions options;
  RandomStream random(54, 0);
  MovingBody body(options, random);
  PoseFilter filter(options);
  for (int frame = 0; frame < 20; ++frame) {
    body.move(0.02, random);
    (void)filter.update(body.time_s, body.measured(random));
  }
  body.move(0.02, random);
  BodyPose wild = body.measured(random);
  wild.estimate->tracker_from_body.translation.x() += 500;
  EXPECT_EQ(filter.update(body.time_s, wild).status, PoseStatus::Predicted);
  body.move(0.02, random);
  EXPECT_EQ(filter.update(body.time_s, body.measured(random)).status, PoseStatus::Ok);
  for (int frame = 0; frame < 2; ++frame) {
    body.move(0.02, random);
    wild = body.measured(random);
    wild.estimate->tracker_from_body.translation.x() += 500;
    const BodyPose filtered = filter.update(body.time_s, wild);
    EXPECT_EQ(filtered.status, frame == 0 ? PoseStatus::Predicted : PoseStatus::Ok);
  }
}

TEST(PoseFilter, DoubtsItsPredictionWhileAPoseContradictsIt) {
  const FilterOptions options;
  for (std::uint64_t run = 0; run < 20; ++run) {
    RandomStream random(56, run);
    MovingBody body(options, random);
    PoseFilter filter(options);
    for (int frame = 0; frame < 20; ++frame) {
      body.move(0.02, random);
      (void)filter.update(body.time_s, body.measured(random));
    }
    // The body is thrown aside, farther than the motion allows for.
    body.move(0.02, random);
    body.truth.translation += Vec3(0, 300, 100);
    body.truth.rotation = (exp_rotation({0.5, 0, 0.2}) * body.truth.rotation).normalized();
    const BodyPose predicted = filter.update(body.time_s, body.measured(random));
    ASSERT_EQ(predicted.status, PoseStatus::Predicted);
    EXPECT_LT(nees(*predicted.estimate, body.truth), 13);  // 95 % of χ² with six degrees
    // Nothing seen in the next frame: the doubt stays.
    body.time_s += 0.02;
    const BodyPose unseen = filter.update(body.time_s, BodyPose{});
    ASSERT_EQ(unseen.status, PoseStatus::Predicted);
    EXPECT_LT(nees(*unseen.estimate, body.truth), 13);
    // Seen again where it was thrown: the filter starts anew and is as sure as the pose is.
    const BodyPose raw = body.measured(random);
    const BodyPose again = filter.update(body.time_s, raw);
    ASSERT_EQ(again.status, PoseStatus::Ok);
    EXPECT_EQ(again.estimate->covariance, raw.estimate->covariance);
  }
}

TEST(PoseFilter, NeverAveragesASystematicErrorAway) {
  FilterOptions options;
  options.rate_wander_deg_s = options.speed_wander_mm_s = 0.1;
  RandomStream random(55, 0);
  MovingBody body(options, random);
  PoseFilter filter(options);
  BodyPose filtered;
  for (int frame = 0; frame < 200; ++frame) {
    body.move(0.01, random);
    BodyPose raw = body.measured(random);
    raw.estimate->systematic = 0.5 * raw.estimate->covariance;
    filtered = filter.update(body.time_s, raw);
  }
  EXPECT_GE(filtered.estimate->covariance(3, 3), 0.5 * body.noise(3, 3));
  EXPECT_LT(filtered.estimate->covariance(3, 3), 0.7 * body.noise(3, 3));
}

TEST(PoseFilter, KeepsAmbiguousAndLostAsTheyAreBeforeTheFirstPose) {
  PoseFilter filter({});
  EXPECT_FALSE(filter.predict(0).has_value());
  EXPECT_EQ(filter.update(0, BodyPose{0, PoseStatus::Ambiguous, {}, 0, 0}).status, PoseStatus::Ambiguous);
  EXPECT_EQ(filter.update(1, BodyPose{}).status, PoseStatus::Lost);
}

TEST(PoseFilter, FollowsAPlatformTurningAboutAFarPivotWithoutLag) {
  FilterOptions options;
  options.rate_wander_deg_s = 0.01;
  options.speed_wander_mm_s = 0.01;
  PoseFilter filter(options);
  BodyPose raw{0, PoseStatus::Ok, PoseEstimate{}, 6, 0};
  raw.estimate->covariance = 1e-12 * Mat6::Identity();
  raw.estimate->covariance.bottomRightCorner<3, 3>() *= 1e6;
  const RigidMotion start{Quaternion::Identity(), Vec3(0, 0, 2000)};
  std::optional<PoseEstimate> predicted;
  for (int frame = 0; frame <= 50; ++frame) {
    const double t = 0.02 * frame;
    const RigidMotion truth = rotation_about({500, 0, 2500}, exp_rotation({0, 0.8 * t, 0})) * start;
    if (frame > 10) {
      predicted = filter.predict(t);
      EXPECT_LT((predicted->tracker_from_body.translation - truth.translation).norm(), 0.01)
          << "frame " << frame;
    }
    raw.estimate->tracker_from_body = truth;
    (void)filter.update(t, raw);
  }
}

}  // namespace
}  // namespace asterism
