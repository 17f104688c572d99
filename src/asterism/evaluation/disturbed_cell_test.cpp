// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/disturbed_cell.hpp"

#include <gtest/gtest.h>

#include "asterism/evaluation/verification_scene_for_tests.hpp"

namespace asterism {
namespace {

namespace scene = verification_scene;

TEST(CalibrationCovariance, IsTheNoiseModelsWhereTheRigStatesNone) {
  const Cell cell = scene::cell();
  const MatX covariance = calibration_covariance(cell);
  ASSERT_EQ(covariance.rows(), 16);  // fx fy skew cx cy, twice; six of the motion
  EXPECT_DOUBLE_EQ(covariance(0, 0), 0.01);
  EXPECT_DOUBLE_EQ(covariance(2, 2), 0);  // nobody spoke of skew
  EXPECT_DOUBLE_EQ(covariance(15, 15), 0.02 * 0.02);
  Cell known = cell;
  known.rig.covariance = MatX::Identity(16, 16);
  EXPECT_DOUBLE_EQ(calibration_covariance(known)(2, 2), 1);
  Cell quiet = test_cell();
  EXPECT_EQ(calibration_covariance(quiet).size(), 0);
}

TEST(RigWithError, MovesEachParameterAndComesBack) {
  const StereoRig rig = scene::cell().rig;
  VecX error = VecX::Zero(16);
  error << 1, 2, 0.5, 3, 4, -1, -2, -0.5, -3, -4, 0, 0, 1e-3, 0.1, 0, 0;
  const StereoRig moved = rig_with_error(rig, error);
  EXPECT_DOUBLE_EQ(moved.left.fy, rig.left.fy + 2);
  EXPECT_DOUBLE_EQ(moved.right.cy, rig.right.cy - 4);
  EXPECT_NEAR(rotation_angle(moved.right_from_left.rotation, rig.right_from_left.rotation), 1e-3, 1e-9);
  EXPECT_NEAR(moved.right_from_left.translation.x() - rig.right_from_left.translation.x(), 0.1, 1e-9);
}

TEST(Disturber, DrawsWithTheSigmasStated) {
  const Cell cell = scene::cell();
  const Disturber disturber(cell, 5);
  const Belief stated = stated_belief(cell);
  constexpr int kRuns = 4000;
  double focal = 0, turn = 0, map = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Belief belief = disturber.belief(static_cast<std::uint64_t>(run));
    focal += std::pow(belief.rig.right.fx - cell.rig.right.fx, 2);
    turn +=
        std::pow(rotation_angle(belief.rig.right_from_left.rotation, cell.rig.right_from_left.rotation), 2);
    map += (belief.bodies[0].targets[3].position - stated.bodies[0].targets[3].position).squaredNorm();
  }
  // A variance of 4000 draws is known to 2.2 %, one of three numbers to 1.3 %: four sigmas.
  EXPECT_NEAR(focal / kRuns / 0.01, 1, 0.09);
  EXPECT_NEAR(turn / kRuns / (3 * std::pow(rad_from_deg(0.001), 2)), 1, 0.05);
  EXPECT_NEAR(map / kRuns / (3 * 0.02 * 0.02), 1, 0.05);
}

TEST(Disturber, GivesLayoutsTheSameRigAndTheSameFirstTargets) {
  const Cell six = scene::cell();
  Cell four = six;
  four.movers[0].body.targets.resize(4);
  const Belief a = Disturber(six, 9).belief(17), b = Disturber(four, 9).belief(17);
  EXPECT_EQ(a.rig.left.fx, b.rig.left.fx);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(a.bodies[0].targets[i].position, b.bodies[0].targets[i].position);
}

TEST(Disturber, LearntTheBodyBeforeItGrewAboutItsPivot) {
  Cell cell = test_cell();
  cell.platform = Platform{};
  cell.platform->pivot_mm = Vec3(0, 0, 600);
  cell.noise = {};
  cell.noise.map_sigma_mm = 0;
  cell.noise.temperature_k = 10;
  const Belief belief = Disturber(cell, 1).belief(0);
  const Vec3 truth = cell.movers[0].body.targets[0].position, learnt = belief.bodies[0].targets[0].position;
  const Vec3 arm = truth - cell.platform->pivot_mm;
  EXPECT_LT((truth - learnt - 115e-6 * arm).norm(),
            1e-4 * 115e-6 * arm.norm() + 1e-12 + 115e-6 * 115e-6 * 300);
}

TEST(ExactBelief, KnowsNoDoubt) {
  const Belief exact = exact_belief(scene::cell());
  EXPECT_EQ(exact.rig.covariance.size(), 0);
  EXPECT_FALSE(exact.bodies[0].targets[0].covariance.has_value());
  EXPECT_TRUE(stated_belief(scene::cell()).bodies[0].targets[0].covariance.has_value());
}

}  // namespace
}  // namespace asterism
