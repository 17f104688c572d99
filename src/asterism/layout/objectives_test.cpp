// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/objectives.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/random.hpp"
#include "asterism/layout/metrics.hpp"

namespace asterism {
namespace {

TEST(LayoutQuantities, AreListedInTheirOrderUnderDifferentNames) {
  const auto& infos = layout_quantities();
  for (std::size_t i = 0; i < infos.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(infos[i].quantity), i);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(infos[i].name, infos[j].name);
  }
  EXPECT_EQ(infos.back().quantity, LayoutQuantity::Moving);
}

TEST(ObjectivesFrom, ReadsNames) {
  const std::vector<LayoutQuantity> expected = {LayoutQuantity::Targets, LayoutQuantity::WorstErrorOneLost};
  EXPECT_EQ(objectives_from(" targets,worst-error-1-lost "), expected);
}

TEST(ObjectivesFrom, RefusesWhatItDoesNotKnow) {
  EXPECT_TELLS(input_error_of([] { (void)objectives_from("targets, worst-eror"); }),
               "did you mean `worst-error`");
  EXPECT_TELLS(input_error_of([] { (void)objectives_from("targets, targets"); }), "given twice");
  EXPECT_TELLS(input_error_of([] { (void)objectives_from("  "); }), "no objective is named");
}

TEST(ConstraintsFrom, ReadsBounds) {
  const auto constraints = constraints_from("visible >= 5, worst-error<=0.25");
  ASSERT_EQ(constraints.size(), 2U);
  EXPECT_EQ(constraints[0].quantity, LayoutQuantity::Visible);
  EXPECT_EQ(constraints[1].bound, 0.25);
  EXPECT_EQ(violation_of(constraints[0], 3), 2);
  EXPECT_EQ(violation_of(constraints[0], 7), 0);
  EXPECT_EQ(violation_of(constraints[1], 0.75), 0.5);
  EXPECT_TRUE(constraints_from("").empty());
}

TEST(ConstraintsFrom, RefusesWhatMakesNoSense) {
  EXPECT_TELLS(input_error_of([] { (void)constraints_from("visible 5"); }), "is not of the form");
  EXPECT_TELLS(input_error_of([] { (void)constraints_from("visible > 5"); }), "is not of the form");
  EXPECT_TELLS(input_error_of([] { (void)constraints_from("visible <= 5"); }), "so it takes >=");
  EXPECT_TELLS(input_error_of([] { (void)constraints_from("visible >= many"); }), "`many` is no number");
  EXPECT_TELLS(input_error_of([] { (void)constraints_from("visible >= 5, visible >= 6"); }), "given twice");
  EXPECT_TELLS(input_error_of([] { (void)constraints_from("thicknes >= 5"); }), "`thickness`");
}

TEST(WarningsAbout, TellThatThePapersObjectivesDoNotConflict) {
  const auto warnings = warnings_about({LayoutQuantity::Targets, LayoutQuantity::MeanSpacing});
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TELLS(warnings[0], "do not conflict");
  EXPECT_TELLS(warnings[1], "how accurate");
  EXPECT_EQ(warnings_about({LayoutQuantity::OriginDistance, LayoutQuantity::Coverage}).size(), 2U);
  EXPECT_TRUE(warnings_about({LayoutQuantity::Targets, LayoutQuantity::WorstErrorOneLost}).empty());
}

// What that warning rests on.
TEST(WarningsAbout, OfAnyLayoutOneTargetCanGoWithoutLoweringTheMeanSpacing) {
  for (std::uint64_t trial = 0; trial < 100; ++trial) {
    RandomStream random(41, trial);
    std::vector<Vec3> layout;
    for (std::uint64_t i = 0; i < 5 + trial % 6; ++i) {
      layout.emplace_back(random.uniform(), random.uniform(), random.uniform());
    }
    double best = 0;
    double mean = 0;
    for (std::size_t left_out = 0; left_out < layout.size(); ++left_out) {
      auto rest = layout;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
      const double spacing = measure_layout(rest).mean_pair_distance_mm;
      best = std::max(best, spacing);
      mean += spacing / static_cast<double>(layout.size());
    }
    const double whole = measure_layout(layout).mean_pair_distance_mm;
    EXPECT_NEAR(mean, whole, 1e-12);
    EXPECT_GE(best, whole - 1e-12);
  }
}

}  // namespace
}  // namespace asterism
