// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/designer.hpp"

#include <gtest/gtest.h>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/layout/cell_for_tests.hpp"

namespace asterism {
namespace {

DesignerOptions quick() {
  DesignerOptions options;
  options.optimizer.population = 60;
  options.optimizer.generations = 12;
  options.places = 100;
  return options;
}

TEST(EvaluateLayout, TellsEverythingOfTheLayoutThatStands) {
  const Cell cell = paper_cell();
  const LayoutDesign design = evaluate_layout(cell, cell.movers[0].body.targets, {});
  EXPECT_EQ(design.targets.size(), 6U);
  EXPECT_TRUE(design.targets[0].normal && design.targets[0].diameter_mm);
  ASSERT_EQ(design.quantities.size(), layout_quantities().size());
  EXPECT_NEAR(*design.value_of(LayoutQuantity::Coverage), design.metrics.pair_distance_sum_mm, 1e-9);
  EXPECT_EQ(design.value_of(LayoutQuantity::Moving), 0);
  EXPECT_EQ(design.accuracy.after.size(), 3U);
  EXPECT_LT(*design.value_of(LayoutQuantity::MeanError), *design.value_of(LayoutQuantity::WorstError));
  EXPECT_LT(*design.value_of(LayoutQuantity::WorstError),
            *design.value_of(LayoutQuantity::WorstErrorOneLost));
  ASSERT_EQ(design.objectives.size(), 3U);
  EXPECT_EQ(design.objectives[1].name, "worst-error-1-lost");
  EXPECT_FALSE(design.feasible());  // at times fewer than five are seen
  EXPECT_EQ(design.constraints[0].name, "visible");
  EXPECT_GT(design.constraints[0].violation, 0);
  EXPECT_EQ(design.constraints.back().violation, 0);
}

TEST(EvaluateLayout, TellsOfATargetOffTheSurface) {
  const Cell cell = paper_cell();
  auto targets = cell.movers[0].body.targets;
  targets[3].position.z() += 7;
  targets[3].position.z() = 627;
  const LayoutDesign design = evaluate_layout(cell, targets, {});
  EXPECT_EQ(design.constraints.back().name, "off-surface");
  EXPECT_NEAR(design.constraints.back().violation, 7, 1e-9);
}

TEST(EvaluateLayout, HasNoErrorWhereThePoseIsNotDetermined) {
  const Cell cell = paper_cell();
  const auto& targets = cell.movers[0].body.targets;
  const LayoutDesign design = evaluate_layout(cell, std::span(targets).first(3), {});
  EXPECT_FALSE(design.value_of(LayoutQuantity::WorstErrorOneLost));
  EXPECT_FALSE(design.feasible());
  EXPECT_TELLS(input_error_of([&] { (void)evaluate_layout(cell, std::span(targets).first(2), {}); }),
               "3 to 64 targets, not 2");
}

TEST(EvaluateLayout, ComparesWithOtherBodies) {
  Cell cell = paper_cell();
  Mover twin = cell.movers[0];
  twin.body.name = "twin";
  for (Target& target : twin.body.targets) target.position += Vec3(5, 0, 0);
  cell.movers.push_back(twin);
  const LayoutDesign design = evaluate_layout(cell, cell.movers[0].body.targets, {});
  EXPECT_EQ(design.identifiability.rms_mm, 10);
  ASSERT_EQ(design.between_bodies.size(), 1U);
  EXPECT_EQ(design.between_bodies[0].body, "twin");
  EXPECT_LT(design.between_bodies[0].margin.rms_mm, 1e-6);
  EXPECT_LT(*design.value_of(LayoutQuantity::Identifiability), 1e-6);
}

TEST(DesignLayouts, FindsLayoutsThatHoldEverythingAndNamesTheKnee) {
  const DesignResult result = design_layouts(paper_cell(), quick());
  ASSERT_FALSE(result.front.empty());
  EXPECT_TRUE(result.infeasible.empty());
  EXPECT_EQ(result.given_up.size(), result.front.size());
  ASSERT_GE(result.knee, 0);
  EXPECT_TELLS(result.why, result.front[static_cast<std::size_t>(result.knee)].name);
  std::size_t before = 0;
  for (const LayoutDesign& design : result.front) {
    EXPECT_TRUE(design.feasible()) << design.name;
    EXPECT_GE(design.targets.size(), before);
    before = design.targets.size();
  }
  EXPECT_EQ(before, 12U);
  ASSERT_TRUE(result.present);
  EXPECT_EQ(result.published.size(), 5U);  // Table 9's S2, S3 and S5 reach beyond the surface
  EXPECT_EQ(result.greedy.size(), 8U);
  EXPECT_EQ(result.history.back().generation, 12);
  EXPECT_EQ(result.pose_times_s.size(), 40U);
}

TEST(DesignLayouts, GivesTheSameBitsForAnyThreadCount) {
  set_thread_count(1);
  const DesignResult one = design_layouts(paper_cell(), quick());
  set_thread_count(3);
  const DesignResult three = design_layouts(paper_cell(), quick());
  set_thread_count(0);
  EXPECT_EQ(one.front_checksum, three.front_checksum);
  ASSERT_EQ(one.front.size(), three.front.size());
  EXPECT_EQ(one.why, three.why);
}

TEST(DesignLayouts, TellsWhatHoldsWithEveryLineOfSightAsked) {
  const Cell cell = shaded_cell(40);
  set_thread_count(1);
  const DesignResult one = design_layouts(cell, quick());
  set_thread_count(3);
  const DesignResult three = design_layouts(cell, quick());
  set_thread_count(0);
  EXPECT_EQ(one.front_checksum, three.front_checksum);
  EXPECT_EQ(one.why, three.why);
  ASSERT_FALSE(one.front.empty());
  const Occlusion occlusion(cell);
  for (const LayoutDesign& design : one.front) {
    EXPECT_TRUE(design.feasible()) << design.name;
    const LayoutDesign again = evaluate_layout(cell, design.targets, quick());
    EXPECT_EQ(again.visibility.seen, design.visibility.seen);
    EXPECT_EQ(again.value_of(LayoutQuantity::WorstErrorOneLost),
              design.value_of(LayoutQuantity::WorstErrorOneLost));
    // Nothing that is told as seen is behind the mast or the beam.
    for (std::size_t pose = 0; pose < 40; ++pose) {
      const auto poses = poses_at(cell, one.pose_times_s[pose]);
      for (std::size_t i = 0; i < design.targets.size(); ++i) {
        if ((design.visibility.seen[pose][0] >> i & 1U) == 0) continue;
        EXPECT_GE(occlusion.free_share(design.targets[i], 0, poses, Side::Left), 0.98);
      }
    }
  }
}

TEST(DesignLayouts, TellsWhatCannotBeHad) {
  DesignerOptions options = quick();
  options.constraints = "worst-error <= 0.001";
  const DesignResult result = design_layouts(paper_cell(), options);
  EXPECT_TRUE(result.front.empty());
  EXPECT_EQ(result.knee, -1);
  EXPECT_TELLS(result.infeasible, "worst-error <= 0.001");
  ASSERT_TRUE(result.closest);
  EXPECT_FALSE(result.closest->feasible());
}

TEST(DesignLayouts, TellsAtMostSoManyDesigns) {
  DesignerOptions options = quick();
  options.most_designs = 5;
  const DesignResult result = design_layouts(paper_cell(), options);
  EXPECT_EQ(result.front.size(), 5U);
  EXPECT_GT(result.front_found, 5U);
  EXPECT_GE(result.knee, 0);
}

TEST(DesignLayouts, CollapsesToTheFewestTargetsUnderThePapersObjectives) {
  DesignerOptions options = quick();
  options.objectives = "targets, mean-spacing";
  options.optimizer.generations = 30;
  const DesignResult result = design_layouts(paper_cell(), options);
  ASSERT_FALSE(result.front.empty());
  // Only where the constraints bite can a target more be worth anything.
  EXPECT_EQ(result.front.front().targets.size(), 5U);
  EXPECT_TELLS(result.warnings[0], "do not conflict");
}

}  // namespace
}  // namespace asterism
