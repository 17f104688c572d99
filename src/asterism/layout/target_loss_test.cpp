// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/target_loss.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

// Enumerated independently of this code, with noise of 0.1 mm.
TEST(ExpectTargetLoss, GivesTheEnumeratedFiguresOfThePapersLayouts) {
  const auto expected = expect_target_loss(places_of(paper_table1()), {}, 1000);
  const LossFigures golden[] = {{284.55, 7.01, 5748.3, 1080.5, 0.810},
                                {312.23, 8.59, 6121.5, 1151.0, 0.758},
                                {264.61, 7.02, 5412.3, 1018.8, 0.998}};
  for (std::size_t l = 0; l < 3; ++l) {
    EXPECT_NEAR(expected[l].expected.mean_cost_mm, golden[l].mean_cost_mm, 0.005);
    EXPECT_NEAR(expected[l].expected.cost_deviation_mm, golden[l].cost_deviation_mm, 0.005);
    EXPECT_NEAR(expected[l].expected.mean_coverage_mm, golden[l].mean_coverage_mm, 0.05);
    EXPECT_NEAR(expected[l].expected.coverage_deviation_mm, golden[l].coverage_deviation_mm, 0.05);
    EXPECT_NEAR(expected[l].expected.front_share, golden[l].front_share, 0.0005);
  }
}

TEST(ExpectTargetLoss, GivesTheCostOfEachDefinition) {
  const double golden[][3] = {{287.2, 315.4, 267.0}, {664, 682, 654}, {424.62, 452.19, 399.80}};
  const double tolerance[] = {0.06, 0.5, 0.005};  // of their last digit
  const LayoutCost costs[] = {LayoutCost::DistanceToFullCentroid, LayoutCost::DistanceToOrigin,
                              LayoutCost::MeanPairDistance};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto expected = expect_target_loss(places_of(paper_table1()), {.cost = costs[c]}, 1000);
    for (std::size_t l = 0; l < 3; ++l) {
      EXPECT_NEAR(expected[l].expected.mean_cost_mm, golden[c][l], tolerance[c]);
    }
  }
}

TEST(DrawTargetLoss, AgreesWithTheEnumerationToFourStandardErrors) {
  constexpr std::size_t kRuns = 20000;
  for (const LayoutCost cost : {LayoutCost::DistanceToOwnCentroid, LayoutCost::DistanceToFullCentroid,
                                LayoutCost::DistanceToOrigin, LayoutCost::MeanPairDistance}) {
    const TargetLossModel model{.cost = cost};
    const auto drawn = figures_of(draw_target_loss(places_of(paper_table1()), model, kRuns, 1));
    const auto expected = expect_target_loss(places_of(paper_table1()), model, kRuns);
    for (std::size_t l = 0; l < 3; ++l) {
      const auto& [mean, error] = expected[l];
      EXPECT_NEAR(drawn[l].mean_cost_mm, mean.mean_cost_mm, 4 * error.mean_cost_mm);
      EXPECT_NEAR(drawn[l].cost_deviation_mm, mean.cost_deviation_mm, 4 * error.cost_deviation_mm);
      EXPECT_NEAR(drawn[l].mean_coverage_mm, mean.mean_coverage_mm, 4 * error.mean_coverage_mm);
      EXPECT_NEAR(drawn[l].coverage_deviation_mm, mean.coverage_deviation_mm,
                  4 * error.coverage_deviation_mm);
      if (cost != LayoutCost::MeanPairDistance) {  // there the noise decides between equal costs
        EXPECT_NEAR(drawn[l].front_share, mean.front_share, 4 * error.front_share + 1e-12);
      }
    }
  }
}

TEST(DrawTargetLoss, GivesTheSameBitsForAnyThreadCount) {
  const auto layouts = places_of(paper_table1());
  set_thread_count(1);
  const auto one = draw_target_loss(layouts, {}, 1000, 5);
  set_thread_count(0);
  const auto many = draw_target_loss(layouts, {}, 1000, 5);
  for (std::size_t l = 0; l < 3; ++l) {
    for (std::size_t r = 0; r < 1000; ++r) {
      ASSERT_EQ(one[l][r].cost_mm, many[l][r].cost_mm);
      ASSERT_EQ(one[l][r].coverage_mm, many[l][r].coverage_mm);
      ASSERT_EQ(one[l][r].on_front, many[l][r].on_front);
    }
  }
}

TEST(DrawTargetLoss, LeavesEverythingOrNothingAtTheEnds) {
  const auto layouts = places_of(paper_table1());
  const auto all = figures_of(draw_target_loss(layouts, {.loss_probability = 0, .noise_mm = 0}, 10, 1));
  EXPECT_NEAR(all[0].mean_coverage_mm, 5748.3 / (0.95 * 0.95), 0.1);  // each pair is left with 0.95²
  EXPECT_EQ(all[0].coverage_deviation_mm, 0);
  const auto none = figures_of(draw_target_loss(layouts, {.loss_probability = 1}, 10, 1));
  EXPECT_EQ(none[2].mean_cost_mm, 0);
  EXPECT_EQ(none[2].front_share, 1);
}

TEST(DrawTargetLoss, RefusesAnEmptyLayoutAndANonsenseProbability) {
  EXPECT_THROW(static_cast<void>(draw_target_loss(std::vector<Layout>{{}}, {}, 1, 1)), ContractViolation);
  EXPECT_THROW(
      static_cast<void>(draw_target_loss(places_of(paper_table1()), {.loss_probability = 1.5}, 1, 1)),
      ContractViolation);
}

}  // namespace
}  // namespace asterism
