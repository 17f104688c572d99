// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/scan_story_report.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

/// Ten samples of 1 mm²; three views of five, four and three of them.
ScanPlan small_plan() {
  ScanPlan plan;
  for (int i = 0; i < 10; ++i) plan.samples.push_back({Vec3(i, 0, 0), Vec3::UnitZ(), 0, 1, 1});
  for (const auto& measures : {std::vector<std::uint32_t>{7, 8, 9}, {0, 1, 2, 3, 4}, {4, 5, 6, 7}}) {
    plan.views.push_back({});
    plan.views.back().measures = measures;
  }
  plan.surface_mm2 = 10;
  plan.reachable_mm2 = plan.coverable_mm2 = plan.covered_mm2 = 10;
  return plan;
}

TEST(ViewsForArea, TakesTheViewThatAddsMostFirst) {
  ScanRound round;
  round.plan = small_plan();
  const auto views = [&](double area_mm2) { return views_for_area(std::span(&round, 1), area_mm2); };
  EXPECT_EQ(views(0), 0U);
  EXPECT_EQ(views(5), 1U);
  EXPECT_EQ(views(5.5), 2U);
  EXPECT_EQ(views(10), 3U);
  EXPECT_FALSE(views(10.5).has_value());
}

TEST(ViewsForArea, TakesTheViewsOfAllRounds) {
  std::vector<ScanRound> rounds(2);
  rounds[0].plan = rounds[1].plan = small_plan();
  rounds[0].plan.views.pop_back();
  rounds[1].plan.views = {small_plan().views.back()};
  EXPECT_FALSE(views_for_area(std::span(rounds).first(1), 9).has_value());
  EXPECT_EQ(views_for_area(rounds, 9), 3U);
}

TEST(StoryRows, TellsWhatIsMeasuredOfWhatCanBe) {
  ScanRound round;
  round.name = "platform at rest";
  round.plan = small_plan();
  round.plan.coverable_mm2 = 8;
  round.fused.completeness = Completeness{};
  round.fused.completeness->surface_mm2 = 10;
  round.fused.completeness->measured_mm2 = 4;
  const auto row = [&] { return story_rows(std::span(&round, 1), {}, 0.1).back(); };
  EXPECT_EQ(row().value, "40.0");
  EXPECT_EQ(row().verdict, Verdict::Attention) << "half of what could be measured is missing";
  round.fused.completeness->measured_mm2 = 7.9;
  EXPECT_EQ(row().verdict, Verdict::Good);
}

TEST(StoryRows, AreNoneWhenNothingWasDone) { EXPECT_TRUE(story_rows({}, {}, 0.1).empty()); }

}  // namespace
}  // namespace asterism
