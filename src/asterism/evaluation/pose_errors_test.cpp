// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/pose_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

PoseRecord pose(int frame, const RigidMotion& motion, const std::string& body = "part") {
  PoseRecord record;
  record.frame = frame;
  record.body = body;
  record.tracker_from_body = motion;
  return record;
}

RigidMotion turned(double deg, const Vec3& shift) { return {exp_rotation({0, 0, rad_from_deg(deg)}), shift}; }

TEST(PoseErrors, KnownTurnAndShiftComeOutAtThePointThatIsNamed) {
  const std::vector<PoseRecord> truth = {pose(0, turned(0, {1, 2, 3}))};
  const std::vector<PoseRecord> measured = {pose(0, turned(0.1, {1, 2, 3.5}))};
  const PoseErrors at_origin = pose_errors(measured, truth, {}).at(0);
  EXPECT_NEAR(at_origin.rotation_deg.rms, 0.1, 1e-12);
  EXPECT_NEAR(at_origin.translation_mm.rms, 0.5, 1e-12);
  PoseErrorOptions away;
  away.at_mm = {600, 0, 0};
  const double chord = 2 * 600 * std::sin(0.5 * rad_from_deg(0.1));
  EXPECT_NEAR(pose_errors(measured, truth, away).at(0).translation_mm.max, std::hypot(chord, 0.5), 1e-9);
}

TEST(PoseErrors, RelativeMotionsDoNotFeelAnotherFrameOfTheTracker) {
  const RigidMotion other{exp_rotation({0.1, -0.2, 0.3}), {5, 6, 7}};
  std::vector<PoseRecord> truth, measured;
  for (int frame = 0; frame < 5; ++frame) {
    const RigidMotion motion = turned(3.0 * frame, {10.0 * frame, 0, 2000});
    truth.push_back(pose(frame, motion));
    measured.push_back(pose(frame, other * motion));
  }
  PoseErrorOptions options;
  options.relative = true;
  const PoseErrors errors = pose_errors(measured, truth, options).at(0);
  EXPECT_EQ(errors.frames.size(), 4U);  // the first is the start
  EXPECT_LT(errors.translation_mm.max, 1e-9);
  EXPECT_LT(errors.rotation_deg.max, 1e-6);
  EXPECT_TRUE(errors.wrong.empty());
}

TEST(PoseErrors, CountsLostWrongAndExtraFramesOfEachBody) {
  const std::vector<PoseRecord> truth = {pose(0, {}), pose(1, {}), pose(2, {}), pose(0, {}, "scanner")};
  std::vector<PoseRecord> measured = {pose(0, {}), pose(1, turned(0.6, {0, 0, 0})), pose(7, {})};
  measured.push_back({2, 0, "part", PoseStatus::Lost, {}, {}, 0, 0});
  const auto errors = pose_errors(measured, truth, {});
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_EQ(errors[0].lost, std::vector<int>{2});
  EXPECT_EQ(errors[0].wrong, std::vector<int>{1});
  EXPECT_EQ(errors[0].extra, std::vector<int>{7});
  EXPECT_EQ(errors[0].found(), 2U);
  EXPECT_EQ(errors[1].body, "scanner");
  EXPECT_EQ(errors[1].found(), 0U);
}

TEST(PoseErrors, HonestCovarianceHasNeesSixAndTooSureOneMore) {
  Mat6 root = Mat6::Identity();
  root.topLeftCorner<3, 3>() *= 1e-4;
  root.bottomRightCorner<3, 3>() *= 0.05;
  root(5, 0) = 0.03;  // errors of turning and shifting go together
  std::vector<PoseRecord> truth, measured;
  for (int frame = 0; frame < 2000; ++frame) {
    RandomStream random(7, static_cast<std::uint64_t>(frame));
    Vec6 draw;
    for (double& value : draw) value = random.normal();
    const RigidMotion seen = turned(5, {100, 200, 2500});
    measured.push_back(pose(frame, seen));
    measured.back().covariance = root * root.transpose();
    truth.push_back(pose(frame, perturbed(seen, root * draw)));
  }
  const PoseErrors honest = pose_errors(measured, truth, {}).at(0);
  ASSERT_TRUE(honest.honesty);
  EXPECT_TRUE(honest.honesty->full);
  EXPECT_NEAR(honest.honesty->mean_nees, 6, 0.31);  // four standard errors: 4 √(12 / 2000)
  EXPECT_NEAR(honest.honesty->in_95_percent, 0.95, 0.02);
  EXPECT_NEAR(*honest.within_two_sigma, 0.9545, 0.012);
  for (PoseRecord& record : measured) *record.covariance *= 0.25;
  EXPECT_NEAR(pose_errors(measured, truth, {}).at(0).honesty->mean_nees, 24, 1.3);
}

TEST(PoseErrors, SigmasAloneAreToldAsSuchAndServeOnlyAtTheOrigin) {
  std::vector<PoseRecord> measured = {pose(0, {})};
  measured[0].covariance = Mat6(Mat6::Identity());
  const std::vector<PoseRecord> truth = {pose(0, turned(0, {0.5, 0, 0}))};
  PoseErrorOptions options;
  EXPECT_FALSE(pose_errors(measured, truth, options).at(0).honesty->full);
  EXPECT_EQ(pose_errors(measured, truth, options).at(0).within_two_sigma, 1.0);
  options.at_mm = {1, 0, 0};
  EXPECT_FALSE(pose_errors(measured, truth, options).at(0).within_two_sigma);
}

TEST(SummaryOf, GivesTheFiveFiguresOfKnownValues) {
  std::vector<double> values;
  for (int i = 1; i <= 100; ++i) values.push_back(i);
  const ErrorSummary summary = summary_of(values);
  EXPECT_DOUBLE_EQ(summary.mean, 50.5);
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt(3383.5));
  EXPECT_DOUBLE_EQ(summary.median, 51);
  EXPECT_DOUBLE_EQ(summary.p95, 96);
  EXPECT_DOUBLE_EQ(summary.max, 100);
  EXPECT_EQ(summary_of({}).max, 0);
}

}  // namespace
}  // namespace asterism
