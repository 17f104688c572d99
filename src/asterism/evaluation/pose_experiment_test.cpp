// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/pose_experiment.hpp"

#include <gtest/gtest.h>

#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/camera/disc_image.hpp"
#include "asterism/evaluation/error_budget.hpp"
#include "asterism/evaluation/verification_scene_for_tests.hpp"

namespace asterism {
namespace {

namespace scene = verification_scene;

std::vector<double> no_inputs(const PoseExperiment& experiment) {
  return std::vector<double>(experiment.input_count(), 0.0);
}

TEST(PoseExperiment, WithoutDisturbanceEveryEstimatorFindsTheTruth) {
  Cell cell = scene::cell();
  for (Target& target : cell.movers[0].body.targets)
    target.normal.reset();  // points: no disc to be biased by
  const PoseExperiment experiment = scene::experiment(cell);
  for (const Estimator estimator :
       {Estimator::MaximumLikelihood, Estimator::LeastSquares, Estimator::ThreePoints}) {
    const auto error = experiment.error(no_inputs(experiment), estimator, 0, {false, false, false});
    ASSERT_TRUE(error.has_value());
    EXPECT_LT(experiment.at_point(*error, Vec3(400, 0, 900)).norm(), 1e-6) << text_of(estimator);
  }
}

TEST(PoseExperiment, HasTheCovarianceThatIsPredictedByAnotherWay) {
  const Cell cell = scene::cell();
  Cell still = standing_still(cell);  // nothing smears
  const PoseExperiment experiment = scene::experiment(still, 0);
  const Belief stated = stated_belief(still);
  const auto predicted =
      predict_pose_accuracy(stated.bodies[0].targets, scene::all_seen(still), experiment.truth(), stated.rig,
                            accuracy_options_of(still, CentreLevel::Centres));
  ASSERT_TRUE(predicted.has_value());
  const ErrorBudget budget = first_order_budget(experiment, Vec3::Zero());
  for (const Vec3& point : {Vec3(0, 0, 600), Vec3(400, 0, 900)}) {
    const double by_inputs = error_at_point_mm(experiment.truth(), budget.covariance, point);
    // The estimator's floor of 0.0005 px is all that tells them apart.
    EXPECT_NEAR(by_inputs / error_at_point_mm(experiment.truth(), predicted->covariance, point), 1, 2e-3);
  }
}

TEST(EstimatePose, StatesThePredictedCovarianceWhenRigAndMapAreUncertain) {
  const Cell cell = standing_still(scene::cell());
  const Belief stated = stated_belief(cell);
  const AccuracyOptions noise = accuracy_options_of(cell, CentreLevel::Centres);
  const RigidMotion truth = pose_at(cell.movers[0].motion, 0);
  std::vector<TargetView> views;
  for (std::size_t target = 0; target < 6; ++target) {
    for (const Side side : {Side::Left, Side::Right}) {
      const RigidMotion camera_from_body = cell.rig.camera_from_tracker(side) * truth;
      const Target& disc = cell.movers[0].body.targets[target];
      const auto centre = project_disc_centre(
          cell.rig.lens(side),
          {camera_from_body * disc.position, camera_from_body.rotation * *disc.normal, 6});
      ASSERT_TRUE(centre.has_value());
      views.push_back(
          {static_cast<int>(target), side, centre->px, Mat2::Identity() * (noise.sigma_px * noise.sigma_px)});
    }
  }
  const auto found = estimate_pose(stated.bodies[0], views, stated.rig, truth, {});
  const auto predicted =
      predict_pose_accuracy(stated.bodies[0].targets, scene::all_seen(cell), truth, stated.rig, noise);
  ASSERT_TRUE(found && predicted);
  // The estimator's floor of 0.0005 px is all that tells them apart.
  EXPECT_LT((found->estimate.covariance - predicted->covariance).norm(), 1e-3 * predicted->covariance.norm());
  EXPECT_LT((found->estimate.systematic - predicted->systematic).norm(), 1e-3 * predicted->systematic.norm());
}

TEST(PoseExperiment, IsLateByLatencyTimesSpeed) {
  Cell cell = scene::cell();
  cell.noise.latency_s = 0.001;
  const PoseExperiment experiment = scene::experiment(cell);
  const auto late =
      experiment.error(no_inputs(experiment), Estimator::MaximumLikelihood, 0, {false, true, false});
  ASSERT_TRUE(late.has_value());
  const Vec3 point(400, 0, 900);
  const Motion& motion = cell.movers[0].motion;
  const Vec3 way = pose_at(motion, 0.301) * point - pose_at(motion, 0.3) * point;
  EXPECT_GT(way.norm(), 0.1);
  EXPECT_LT((experiment.at_point(*late, point) - way).norm(), 1e-3 * way.norm());  // turned by 0.1 %
}

TEST(PoseExperiment, SmearsAlongTheWayOfTheImage) {
  Cell cell = scene::cell();
  cell.sensor.exposure_s = 0.02;
  const ErrorBudget moving = first_order_budget(scene::experiment(cell), Vec3::Zero());
  const ErrorBudget still = first_order_budget(scene::experiment(standing_still(cell), 0), Vec3::Zero());
  const auto smear = static_cast<std::size_t>(ErrorSource::Smear);
  EXPECT_GT(moving.shares[smear].sigma_mm, 0.1 * moving.shares[0].sigma_mm);
  EXPECT_EQ(still.shares[smear].sigma_mm, 0);
}

TEST(PoseExperiment, SaysWhyThereIsNoPose) {
  const PoseExperiment experiment = scene::experiment(scene::cell());
  const auto few = experiment.error(no_inputs(experiment), Estimator::MaximumLikelihood, 0b111101);
  ASSERT_FALSE(few.has_value());
  EXPECT_EQ(few.error(), PoseFailure::TooFewViews);
  EXPECT_TRUE(experiment.error(no_inputs(experiment), Estimator::MaximumLikelihood, 0b000011).has_value());
}

TEST(ErrorBudget, HasSharesThatSumToOneAndIsConfirmedByDraws) {
  const Cell cell = scene::cell();
  const PoseExperiment experiment = scene::experiment(cell);
  const ErrorBudget budget = error_budget(experiment, Vec3(400, 0, 900), {3, 2});
  double sum = 0, square = 0;
  for (const BudgetShare& share : budget.shares) {
    sum += share.share;
    square += share.sigma_mm * share.sigma_mm;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_GT(budget.shares[static_cast<std::size_t>(ErrorSource::Map)].share, 0.01);
  EXPECT_GT(budget.shares[static_cast<std::size_t>(ErrorSource::Calibration)].share, 0.01);
  EXPECT_NEAR(std::sqrt(square), budget.rms_mm, 1e-6 + 1e-3 * budget.rms_mm);  // no bias to speak of
  // 20000 draws know a deviation to 0.5 %.
  EXPECT_NEAR(budget.drawn.uncertainty / budget.first.uncertainty, 1, 0.02);
  EXPECT_TRUE(budget.check.valid);
  EXPECT_GT(budget.below_95_mm, budget.rms_mm);
  EXPECT_LT(budget.below_95_mm, 2 * budget.rms_mm);
}

TEST(PoseExperiment, RisesWithTheTargetsThatGrowAboveThePivot) {
  Cell cell = test_cell();
  cell.platform = Platform{};
  cell.noise.map_sigma_mm = 0;
  cell.noise.temperature_k = 5;
  for (Target& target : cell.movers[0].body.targets) target.normal.reset();
  const PoseExperiment experiment = scene::experiment(standing_still(cell), 0);
  const Vec3 centroid = verification_of(cell).points[VerifiedBody::kCentroid].in_body_mm;
  const double growth = 5 * 11.5e-6 * centroid.norm();
  const auto fitted = experiment.error(no_inputs(experiment), Estimator::LeastSquares);
  ASSERT_TRUE(fitted.has_value());
  EXPECT_NEAR(experiment.at_point(*fitted, centroid).norm(), growth, 1e-3 * growth);
  // Depth is known least, so to the likeliest pose larger targets are also nearer ones: it errs by more.
  const ErrorBudget budget = first_order_budget(experiment, centroid);
  const BudgetShare& thermal = budget.shares[static_cast<std::size_t>(ErrorSource::Thermal)];
  EXPECT_GT(thermal.bias_mm.norm(), growth);
}

TEST(ErrorBudget, RefusesAMomentWithoutAPose) {
  const Cell cell = scene::cell();
  const PoseExperiment blind(cell, 0, 0, {0b11, 0b11}, accuracy_options_of(cell, CentreLevel::Centres));
  EXPECT_THROW(static_cast<void>(first_order_budget(blind, Vec3::Zero())), MeasurementError);
}

}  // namespace
}  // namespace asterism
