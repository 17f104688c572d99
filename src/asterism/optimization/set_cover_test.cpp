// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/set_cover.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/optimization/cover_problems_for_tests.hpp"

namespace asterism {
namespace {

SetCover solved(const SetCoverProblem& problem, const SetCoverOptions& options = {}) {
  return solve(problem, options, 1, no_progress);
}

/// Small problems of every form: `form` is a set of bits.
SetCoverProblem small_problem(std::uint64_t seed, unsigned form) {
  SetCoverProblem problem = random_cover(14, 11, 0.3, seed);
  RandomStream random(seed, 1, 7);
  if ((form & 1U) != 0)
    for (std::size_t j = 0; j < problem.columns.size(); ++j) problem.cost.push_back(random.uniform(1, 3));
  if ((form & 2U) != 0) {
    problem.share = random.uniform(0.5, 0.95);
    for (std::size_t i = 0; i < problem.rows; ++i) problem.weight.push_back(random.uniform(0, 2));
  }
  if ((form & 4U) != 0)
    for (std::size_t i = 0; i < problem.rows; ++i)
      problem.demand.push_back(static_cast<int>(random.below(4)));
  if ((form & 8U) != 0) {
    problem.group_cost = {0, 1.5, 0.5};
    for (std::size_t j = 0; j < problem.columns.size(); ++j) problem.group.push_back(random.below(3));
  }
  return problem;
}

void expect_sound(const SetCoverProblem& problem, const SetCover& cover, const std::string& which) {
  const CoverWorth worth = worth_of(problem, cover.chosen);
  EXPECT_TRUE(is_enough(problem, worth)) << which;
  // sums in another order
  EXPECT_NEAR(cover.cost, worth.cost, 1e-9) << which;
  EXPECT_NEAR(cover.covered, worth.covered, 1e-9) << which;
  EXPECT_NEAR(cover.coverable, worth.coverable, 1e-9) << which;
  EXPECT_LE(cover.bound, cover.cost + 1e-9) << which;
  EXPECT_LE(cover.local_cost, cover.greedy_cost + 1e-9) << which;
}

void expect_refused(const std::function<void(SetCoverProblem&)>& spoil, const std::string& message) {
  SetCoverProblem problem = random_cover(4, 3, 0.5, 1);
  problem.columns[1] = {0, 2};
  spoil(problem);
  try {
    (void)solved(problem);
    FAIL() << "taken, but expected: " << message;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string("set cover: ") + message, error.what());
  }
}

TEST(SetCover, BoundIsNeverAboveTheLeastCostInAnyForm) {
  for (unsigned form = 0; form < 16; ++form)
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const SetCoverProblem problem = small_problem(seed, form);
      const std::string which = "form " + std::to_string(form) + ", seed " + std::to_string(seed);
      const double least = least_cost(problem);
      const SetCover cover = solved(problem, {0, 0, 0, true});
      expect_sound(problem, cover, which);
      EXPECT_GE(cover.cost, least - 1e-9) << which;
      EXPECT_LE(cover.bound, least + 1e-9) << which;
      EXPECT_TRUE(!cover.optimal || cover.cost <= least + 1e-9) << which;
    }
}

TEST(SetCover, FindsTheLeastCostInAnyForm) {
  for (unsigned form = 0; form < 16; ++form)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const SetCoverProblem problem = small_problem(seed, form);
      const std::string which = "form " + std::to_string(form) + ", seed " + std::to_string(seed);
      for (const int local_steps : {0, 300}) {
        const SetCover cover = solved(problem, {local_steps, 5, 0, true});
        expect_sound(problem, cover, which);
        EXPECT_NEAR(cover.cost, least_cost(problem), 1e-6) << which;
        EXPECT_TRUE(cover.optimal) << which << ": " << cover.exact;
      }
    }
}

TEST(SetCover, FindsTheBestKnownCoversOfCubesAndTripleSystems) {
  const SetCoverOptions local{100000, 0, 0, true};
  EXPECT_EQ(solved(cube_cycles(6), local).cost, 60);
  EXPECT_EQ(solved(cube_cycles(7), local).cost, 144);
  const std::pair<std::uint32_t, double> systems[] = {{9, 5}, {15, 9}, {27, 18}, {45, 30}, {81, 61}};
  for (const auto& [points, best] : systems) EXPECT_EQ(solved(steiner_cover(points), local).cost, best);
}

TEST(SetCover, IsTheSameForAnyNumberOfThreads) {
  const SetCoverProblem problem = disc_cover(300, 300, 0.3, 1);
  std::vector<SetCover> covers;
  for (const int threads : {1, 2, 3}) {
    set_thread_count(threads);
    covers.push_back(solved(problem, {2000, 2, 0, true}));
  }
  set_thread_count(0);
  for (const SetCover& cover : covers) {
    EXPECT_EQ(cover.chosen, covers[0].chosen);
    EXPECT_EQ(cover.bound, covers[0].bound);
    EXPECT_EQ(cover.exact, covers[0].exact);
  }
}

TEST(SetCover, StopsByCountWhereTheTimeIsShort) {
  const SetCoverProblem problem = steiner_cover(45);
  const SetCover cover = solved(problem, {0, 0.02, 0, true});
  expect_sound(problem, cover, "STS 45");
  EXPECT_FALSE(cover.optimal);
  EXPECT_GE(cover.bound, 15);  // of the linear relaxation
  EXPECT_LE(cover.bound, 30);  // the optimum
  EXPECT_EQ(cover.exact.rfind("stopped by its count of iterations", 0), 0U) << cover.exact;
}

TEST(SetCover, IsContentWithAGap) {
  SetCoverOptions options{0, 5, 0.4, true};
  const SetCover cover = solved(steiner_cover(27), options);
  EXPECT_LE(cover.gap(), 0.4 + 1e-9);
  EXPECT_LE(cover.bound, 18);
  EXPECT_GE(cover.cost, 18);
}

TEST(SetCover, CoversNothingAtNoCost) {
  SetCoverProblem problem;
  problem.rows = 5;
  const SetCover cover = solved(problem);
  EXPECT_TRUE(cover.chosen.empty());
  EXPECT_EQ(cover.cost, 0);
  EXPECT_EQ(cover.coverable, 0);
  EXPECT_TRUE(cover.optimal);
}

TEST(SetCover, TellsTheColumnsInTheOrderOfWhatEachAdds) {
  SetCoverProblem problem;
  problem.rows = 6;
  problem.columns = {{5}, {0, 1, 2}, {3, 4}};
  EXPECT_EQ(solved(problem).chosen, (std::vector<std::uint32_t>{1, 2, 0}));
}

TEST(SetCover, RefusesWhatIsNotThereOrCannotBe) {
  using Problem = SetCoverProblem;
  expect_refused(
      [](Problem& p) {
        p.columns[1] = {0, 4};
      },
      "column 1 covers row 4, but there are 4 rows, counted from 0");
  expect_refused(
      [](Problem& p) {
        p.columns[1] = {2, 2};
      },
      "column 1 names row 2 after row 2; rows must ascend");
  expect_refused([](Problem& p) { p.cost = {1, 2}; }, "2 costs for 3 columns; give one each or none");
  expect_refused([](Problem& p) { p.cost = {1, 0, 1}; }, "column 1 costs 0; a cost must be above 0");
  expect_refused([](Problem& p) { p.weight = {1, 1, 1, -2}; }, "row 3 weighs -2; a weight must be 0 or more");
  expect_refused(
      [](Problem& p) {
        p.demand = {1, 1, 1, -1};
      },
      "row 3 demands -1 columns; it must be 0 or more");
  expect_refused(
      [](Problem& p) {
        p.group = {0, 0, 1};
        p.group_cost = {3};
      },
      "column 2 is of group 1, but 1 groups have a cost");
  expect_refused([](Problem& p) { p.group_cost = {-1}; }, "group 0 costs -1; a cost must be 0 or more");
  expect_refused([](Problem& p) { p.share = 1.5; },
                 "a share of 1.5 is to be covered; it must be above 0 and at most 1");
}

}  // namespace
}  // namespace asterism
