// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/cover_reductions.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

using Numbers = std::vector<std::uint32_t>;

SetCoverProblem of(std::size_t rows, std::vector<Numbers> columns) {
  SetCoverProblem problem;
  problem.rows = rows;
  problem.columns = std::move(columns);
  return problem;
}

TEST(Reduced, SolvesAProblemThatIsForced) {
  // row 0 forces column 0, which leaves row 3; column 2 covers what 1 does
  const ReducedCover left = reduced(model_of(of(4, {{0, 1, 2}, {3}, {2, 3}})));
  EXPECT_EQ(left.model.rows(), 0U);
  EXPECT_EQ(left.model.columns(), 0U);
  ASSERT_EQ(left.forced.size(), 2U);
  EXPECT_EQ(left.forced[0], 0U);
}

TEST(Reduced, AddsWeightsOfRowsAlikeWhereAShareWillDo) {
  SetCoverProblem problem = of(4, {{0, 1, 2}, {2, 3}, {0, 1, 3}});
  problem.weight = {1, 2, 4, 8};
  problem.share = 0.5;
  const ReducedCover left = reduced(model_of(problem));
  EXPECT_EQ(left.model.rows(), 3U) << "rows 0 and 1 are one; none goes because another is covered";
  EXPECT_EQ(left.model.weight[0] + left.model.weight[1] + left.model.weight[2], 15);
  EXPECT_EQ(left.model.target, 8);
  EXPECT_TRUE(left.forced.empty());
}

TEST(Reduced, CountsWhatOpeningAGroupCosts) {
  SetCoverProblem problem = of(3, {{0, 1, 2}, {0, 1}, {0, 2}, {1, 2}});
  problem.cost = {3, 2, 3, 3};
  problem.group = {0, 0, 0, 1};
  problem.group_cost = {0, 5};
  const ReducedCover left = reduced(model_of(problem));
  // 2 does no more than 0 for as much, and 3 would open group 1 besides; then only 0 covers row 2
  EXPECT_EQ(left.forced, (Numbers{0}));
  EXPECT_EQ(left.model.rows(), 0U);

  problem.group = {1, 0, 0, 0};
  EXPECT_EQ(reduced(model_of(problem)).column, (Numbers{0, 1, 2, 3})) << "0 opens group 1";
}

TEST(Reduced, KeepsWhatASecondViewNeeds) {
  SetCoverProblem problem = of(2, {{0, 1}, {0, 1}, {0, 1}});
  problem.demand = {2, 2};
  EXPECT_EQ(reduced(model_of(problem)).model.columns(), 3U);
}

}  // namespace
}  // namespace asterism
