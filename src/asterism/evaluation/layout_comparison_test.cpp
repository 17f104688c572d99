// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/layout_comparison.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "asterism/core/parallel.hpp"
#include "asterism/evaluation/estimator_comparison.hpp"
#include "asterism/evaluation/verification_scene_for_tests.hpp"

namespace asterism {
namespace {

namespace scene = verification_scene;

LayoutRuns runs_of(const Cell& cell, double factor, std::size_t runs, std::uint64_t seed = 1) {
  DisturbanceOptions options;
  options.runs = runs;
  options.seed = seed;
  return disturb(scene::trial(cell, fmt::format("x{}", factor), scene::scaled_targets(cell, factor)),
                 options);
}

TEST(Disturb, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Cell cell = scene::cell();
  set_thread_count(1);
  const LayoutRuns one = runs_of(cell, 1, 50);
  set_thread_count(4);
  const LayoutRuns four = runs_of(cell, 1, 50);
  set_thread_count(0);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(one.at_rest[i], four.at_rest[i]);
    EXPECT_EQ(one.moving[i], four.moving[i]);
  }
}

TEST(Disturb, CountsPosesThatLossesTook) {
  const Cell cell = scene::cell();
  DisturbanceOptions options;
  options.runs = 100;
  options.target_loss = 0.7;
  const LayoutRuns runs = disturb(scene::trial(cell, "lossy", cell.movers[0].body.targets), options);
  EXPECT_EQ(runs.poses, 400U);
  EXPECT_GT(runs.without_pose, 200U);
  EXPECT_LT(runs.without_pose, 400U);
}

TEST(CompareLayouts, FindsTheWiderLayoutBetterAndSaysHowManyRunsItTakes) {
  const Cell cell = scene::cell();
  const std::vector<LayoutRuns> layouts = {runs_of(cell, 1, 1000), runs_of(cell, 1.03, 1000)};
  const LayoutComparison comparison = compare_layouts(layouts, RunQuantity::RotationDeg, true);
  ASSERT_EQ(comparison.pairs.size(), 1U);
  const PairOfLayouts& pair = comparison.pairs[0];
  EXPECT_GT(pair.all.difference, 0);  // the first one errs more
  EXPECT_LT(pair.all_p_holm, 0.001);
  ASSERT_TRUE(pair.runs_needed.has_value());
  const TTestPlan plan{std::abs(pair.all.effect_size)};
  EXPECT_GE(power_of_t_test(plan, *pair.runs_needed), 0.8);
  EXPECT_LT(power_of_t_test(plan, *pair.runs_needed - 1), 0.8);
  EXPECT_EQ(comparison.first_runs, 50U);
  EXPECT_TRUE(comparison.layouts[0].all_interval.holds(comparison.layouts[0].all.mean));
  EXPECT_LT(comparison.layouts[0].all_interval.width(), comparison.layouts[0].first_interval.width());
}

TEST(CompareLayouts, FindsNoDifferenceBetweenALayoutAndItself) {
  const Cell cell = scene::cell();
  // Once as it is, once as a file would round it.
  const std::vector<LayoutRuns> same = {runs_of(cell, 1, 60), runs_of(cell, 1 + 1e-9, 60)};
  const LayoutComparison comparison = compare_layouts(same, RunQuantity::CentroidMm, true);
  EXPECT_EQ(comparison.pairs[0].all_p_holm, 1);
  EXPECT_FALSE(comparison.pairs[0].runs_needed.has_value());
}

TEST(CompareLayouts, PairsRunsUnderCommonRandomNumbers) {
  const Cell cell = scene::cell();
  const LayoutRuns a = runs_of(cell, 1, 500), b = runs_of(cell, 1.05, 500),
                   other = runs_of(cell, 1.05, 500, 2);
  const auto error_of_difference = [](const LayoutRuns& x, const LayoutRuns& y) {
    return compare_layouts(std::vector<LayoutRuns>{x, y}, RunQuantity::CentroidMm, true)
        .pairs[0]
        .all.standard_error;
  };
  EXPECT_LT(error_of_difference(a, b), 0.5 * error_of_difference(a, other));
}

TEST(CompareLayouts, RefusesWhenHardlyAnyRunHasAPose) {
  LayoutRuns none{"none", {}, {}, 0, 0};
  none.at_rest.resize(10);
  none.moving.resize(10);
  EXPECT_THROW(
      static_cast<void>(compare_layouts(std::vector<LayoutRuns>{none}, RunQuantity::CentroidMm, true)),
      MeasurementError);
}

TEST(CompareEstimators, MaximumLikelihoodReachesTheBoundAndTheOthersDoNot) {
  Cell cell = scene::cell();
  cell.noise = {};
  cell.noise.sigma_px = 0.2;
  cell.noise.map_sigma_mm = 0;
  for (Target& target : cell.movers[0].body.targets) target.normal.reset();
  const std::vector<LayoutTrial> trials = {scene::trial(cell, "present", cell.movers[0].body.targets)};
  const std::vector<Estimator> estimators = {Estimator::MaximumLikelihood, Estimator::LeastSquares,
                                             Estimator::ThreePoints};
  const auto rows =
      compare_estimators(cell, trials, estimators, accuracy_options_of(cell, CentreLevel::Centres), {500, 1});
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 0; i < kRunQuantities; ++i) {
    // 2000 poses know an RMS to 1.3 % or so.
    EXPECT_NEAR(rows[0].errors[i].over_bound(), 1, 0.05) << text_of(static_cast<RunQuantity>(i));
    EXPECT_GT(rows[1].errors[i].rms, 0.99 * rows[0].errors[i].rms);
    EXPECT_GT(rows[2].errors[i].rms, rows[1].errors[i].rms);
  }
  EXPECT_GT(rows[1].errors[0].over_bound(), 1.1);
  EXPECT_EQ(rows[0].poses, 2000U);
}

}  // namespace
}  // namespace asterism
