// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/layout_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/layout/cell_for_tests.hpp"
#include "asterism/layout/metrics.hpp"

namespace asterism {
namespace {

struct Evaluated {
  std::vector<double> objectives, violations;
};
Evaluated evaluated(const LayoutProblem& problem, const Genes& genes) {
  Evaluated result{std::vector<double>(problem.objectives().size()),
                   std::vector<double>(problem.constraints().size())};
  problem.evaluate(genes, result.objectives, result.violations);
  return result;
}

std::string refusal(const Cell& cell, const DesignerOptions& options = {}) {
  return input_error_of([&] { const LayoutProblem problem(cell, options); });
}

TEST(LayoutProblem, EvaluatesWhatItsRoomsSay) {
  const LayoutProblem problem(paper_cell(), {});
  const auto& targets = paper_table1()[2].targets;
  const Evaluated result = evaluated(problem, genes_of(targets));
  ASSERT_EQ(result.objectives.size(), 3U);
  EXPECT_EQ(result.objectives[0], 6);
  EXPECT_EQ(result.objectives[2], -10);  // its margin of 14.9 mm counts as the cap

  const LayoutModel& model = problem.model();
  const auto all = model.targets_at(targets);
  const auto seen = visible_targets(all, model.motion, model.volume, {});
  int fewest = 64;
  for (std::size_t pose = 0; pose < seen.poses(); ++pose) {
    fewest = std::min(fewest, std::popcount(seen.both(pose)));
  }
  EXPECT_EQ(result.violations[0], 5 - fewest);
  const auto accuracy = predict_accuracy(all, model.motion, seen, model.points, {});
  EXPECT_EQ(result.objectives[1], accuracy.after[1].worst->mm);
}

TEST(LayoutProblem, DoesNotMindTheOrderOfTargets) {
  const LayoutProblem problem(paper_cell(), {});
  auto targets = paper_table1()[2].targets;
  const Evaluated one = evaluated(problem, genes_of(targets));
  std::reverse(targets.begin(), targets.end());
  const Evaluated other = evaluated(problem, genes_of(targets));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(one.objectives[k], other.objectives[k], 1e-9);
}

void expect_kept(const Genes& genes, const LayoutRules& rules) {
  const auto layout = positions_of(genes);
  EXPECT_GE(static_cast<int>(layout.size()), rules.fewest);
  EXPECT_LE(static_cast<int>(layout.size()), rules.most);
  EXPECT_GE(measure_layout(layout).min_pair_distance_mm, rules.spacing_mm);
  for (const Vec3& p : layout) EXPECT_LT((nearest_place(rules.surface, p).position_mm - p).norm(), 1e-6);
}

TEST(LayoutProblem, SamplesSeedsAndChildrenKeepTheRules) {
  const LayoutProblem problem(paper_cell(), {});
  const LayoutRules& rules = problem.model().rules;
  std::vector<Genes> genes = problem.seeds();
  std::vector<bool> count_seen(13);
  for (std::uint64_t i = 0; i < 50; ++i) {
    RandomStream random(51, i);
    genes.push_back(problem.sample(random));
    count_seen[genes.back().size() / 3] = true;
  }
  EXPECT_EQ(std::count(count_seen.begin(), count_seen.end(), true), 8);  // 5 to 12
  for (std::uint64_t i = 0; i < 100; ++i) {
    RandomStream random(52, i);
    Genes daughter, son;
    problem.vary(genes[i % genes.size()], genes[7 * i % genes.size()], daughter, son, random);
    genes.push_back(daughter);
    genes.push_back(son);
  }
  for (const Genes& one : genes) expect_kept(one, rules);
}

TEST(LayoutProblem, StartsFromThePublishedAndTheGreedyLayouts) {
  const LayoutProblem problem(paper_cell(), {});
  const auto seeds = problem.seeds();
  auto published = paper_table1()[1].targets;
  put_in_order(published);
  EXPECT_NE(std::find(seeds.begin(), seeds.end(), genes_of(published)), seeds.end());
  for (const GreedyLayout& greedy : problem.greedy()) EXPECT_GE(greedy.guaranteed, 0.63);
  EXPECT_EQ(problem.greedy().size(), 12U);
  std::vector<bool> count_seen(13);
  for (const Genes& seed : seeds) count_seen[seed.size() / 3] = true;
  EXPECT_EQ(std::count(count_seen.begin(), count_seen.end(), true), 8);
}

TEST(LayoutProblem, KeepsNichesOnlyWhereTheNumberIsAnObjective) {
  const Genes six = genes_of(paper_table1()[0].targets);
  EXPECT_EQ(LayoutProblem(paper_cell(), {}).niche_of(six), 6U);
  DesignerOptions accuracy_only;
  accuracy_only.objectives = "worst-error, identifiability";
  EXPECT_EQ(LayoutProblem(paper_cell(), accuracy_only).niche_of(six), 0U);
}

TEST(LayoutProblem, IsToldApartByWhatDecides) {
  const std::string identity = LayoutProblem(paper_cell(), {}).identity();
  EXPECT_EQ(LayoutProblem(paper_cell(), {}).identity(), identity);
  DesignerOptions sigma;
  sigma.accuracy.sigma_px = 0.06;
  EXPECT_NE(LayoutProblem(paper_cell(), sigma).identity(), identity);
  EXPECT_NE(LayoutProblem(paper_cell(351), {}).identity(), identity);
  EXPECT_NE(LayoutProblem(paper_cell(350, 41), {}).identity(), identity);
  Cell point = paper_cell();
  point.layout->points[0].in_body_mm.x() += 1;
  EXPECT_NE(LayoutProblem(point, {}).identity(), identity);
  Cell lens = paper_cell();
  lens.rig.right.distortion[0] = 0.01;
  lens.rig.right.coefficients = 4;
  EXPECT_NE(LayoutProblem(lens, {}).identity(), identity);
  Cell clamp = paper_cell();
  clamp.layout->surface.keep_outs.push_back({"clamp", Box{{2, 2, 2}}, {}});  // where nothing stands anyway
  EXPECT_NE(LayoutProblem(clamp, {}).identity(), identity);
}

TEST(LayoutProblem, IsToldApartByWhatHidesTargets) {
  const std::string identity = LayoutProblem(shaded_cell(), {}).identity();
  EXPECT_EQ(LayoutProblem(shaded_cell(), {}).identity(), identity);
  EXPECT_NE(LayoutProblem(paper_cell(350, 12, 2600, 0), {}).identity(), identity);
  Cell moved = shaded_cell();
  moved.obstacles[1].carrier_from_shape.translation.z() += 1;
  EXPECT_NE(LayoutProblem(moved, {}).identity(), identity);
  Cell carried = shaded_cell();
  carried.obstacles[1].body = "platform";
  EXPECT_NE(LayoutProblem(carried, {}).identity(), identity);
  DesignerOptions rays;
  rays.occlusion.rays = 32;
  EXPECT_NE(LayoutProblem(shaded_cell(), rays).identity(), identity);
}

TEST(LayoutProblem, IsNoBetterByItsTableOfShadowsThanWithEveryRayAsked) {
  const LayoutProblem problem(shaded_cell(), {});
  ASSERT_FALSE(problem.shadows().empty());
  int differ = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    RandomStream random(53, i);
    const Genes genes = problem.sample(random);
    const Evaluated by_table = evaluated(problem, genes);
    Evaluated exact = by_table;
    problem.evaluate_exactly(genes, exact.objectives, exact.violations);
    EXPECT_LE(exact.violations[0], by_table.violations[0]);               // fewest visible
    EXPECT_LE(exact.objectives[1], by_table.objectives[1] * (1 + 1e-9));  // worst error
    differ += exact.objectives[1] < by_table.objectives[1] ? 1 : 0;
  }
  EXPECT_GT(differ, 10);
  const LayoutProblem free(paper_cell(), {});
  EXPECT_TRUE(free.shadows().empty());
  const Genes genes = genes_of(paper_table1()[2].targets);
  Evaluated exact = evaluated(free, genes);
  free.evaluate_exactly(genes, exact.objectives, exact.violations);
  EXPECT_EQ(exact.objectives, evaluated(free, genes).objectives);
}

TEST(LayoutProblem, SaysThatAllIsHidden) {
  Cell cell = shaded_cell();
  cell.obstacles[1].shape = Box{{3000, 3000, 10}};
  EXPECT_TELLS(refusal(cell), "none of 400 places of the surface is seen by both cameras: hidden");
}

TEST(LayoutProblem, TellsWhichTaskIsNone) {
  Cell cell = paper_cell();
  cell.layout.reset();
  EXPECT_TELLS(refusal(cell), "states no layout task");
  cell = paper_cell();
  cell.layout->body = "part";
  EXPECT_TELLS(refusal(cell), "body `part` is not there; bodies are: platform");
}

TEST(LayoutProblem, RefusesASurfaceTooSmall) {
  Cell cell = paper_cell(104);
  cell.layout->fewest = 12;
  const std::string message = refusal(cell);
  EXPECT_TELLS(message, "holds no 12 targets 100 mm apart: room was found for 7");  // six about one
  cell = paper_cell();
  cell.layout->surface.keep_outs.push_back({"all", Box{{5000, 5000, 5000}}, {}});
  EXPECT_TELLS(refusal(cell), "room was found for 0");
}

TEST(LayoutProblem, LowersTheMostWhereThereIsRoomForFewer) {
  const LayoutProblem problem(paper_cell(104), {});
  EXPECT_EQ(problem.model().rules.most, 7);
  ASSERT_FALSE(problem.warnings().empty());
  EXPECT_TELLS(problem.warnings()[1], "room was found for 7 targets");
}

TEST(LayoutProblem, RefusesWhatNoCameraSees) {
  Cell cell = paper_cell();
  std::get<Sweep>(cell.movers[0].motion).tracker_from_rest.rotation =
      std::get<Sweep>(cell.movers[0].motion).tracker_from_rest.rotation *
      exp_rotation(Vec3(std::numbers::pi, 0, 0));
  const std::string upside_down = refusal(cell);
  EXPECT_TELLS(upside_down, "in 40 of 40 poses, first at 0.000 s, none of 400 places");
  cell = paper_cell();
  cell.volume = WorkingVolume{};
  cell.volume->near_mm = 5000;
  cell.volume->far_mm = 6000;
  EXPECT_TELLS(refusal(cell), "none of 400 places of the surface is seen by both cameras: ");
}

TEST(LayoutProblem, RefusesMoreVisibleThanThereMayBe) {
  Cell cell = paper_cell();
  cell.layout->most = 4;
  EXPECT_TELLS(refusal(cell), "5 targets must be visible, but `most` is 4");
}

TEST(LayoutProblem, WarnsOfFewTargetsAndOfThePapersObjectives) {
  DesignerOptions papers;
  papers.objectives = "targets, mean-spacing";
  const auto warnings = LayoutProblem(paper_cell(), papers).warnings();
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_TELLS(warnings[0], "do not conflict");
  EXPECT_TELLS(warnings[2], "fewer than 5 targets");
}

}  // namespace
}  // namespace asterism
