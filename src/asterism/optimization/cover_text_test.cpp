// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/cover_text.hpp"

#include <gtest/gtest.h>

#include <string>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

void expect_refused(const std::string& text, const std::string& message) {
  try {
    (void)cover_problem_of(text, "turbine.txt");
    FAIL() << "taken, but expected: " << message;
  } catch (const InputError& error) {
    EXPECT_EQ(message, error.what());
  }
}

TEST(CoverText, IsTheFormOfTheOrLibrary) {
  SetCoverProblem problem;
  problem.rows = 3;
  problem.columns = {{0, 2}, {2}};
  EXPECT_EQ(text_of(problem), "2 2\n1 1\n1\n1\n2\n1 2\n") << "row 1, which no column covers, is left out";
}

TEST(CoverText, ComesBackAsItWas) {
  SetCoverProblem problem;
  problem.rows = 3;
  problem.columns = {{0, 2}, {1, 2}, {}, {0}};
  problem.cost = {1, 0.1, 3, 1.0 / 3};
  problem.weight = {2, 0.7, 1e-9};
  problem.demand = {2, 1, 0};
  problem.share = 0.95;
  problem.group = {0, 1, 1, 0};
  problem.group_cost = {0, 2.5};
  const SetCoverProblem back = cover_problem_of(text_of(problem), "here");
  EXPECT_EQ(back.rows, problem.rows);
  EXPECT_EQ(back.columns, problem.columns);
  EXPECT_EQ(back.cost, problem.cost);
  EXPECT_EQ(back.weight, problem.weight);
  EXPECT_EQ(back.demand, problem.demand);
  EXPECT_EQ(back.share, problem.share);
  EXPECT_EQ(back.group, problem.group);
  EXPECT_EQ(back.group_cost, problem.group_cost);
}

TEST(CoverText, NamesTheLineThatIsWrong) {
  expect_refused("", "turbine.txt:1: ends where the number of rows should be");
  expect_refused("2 2\n1 x", "turbine.txt:2: `x` where a column's cost should be");
  expect_refused("1 2\n1 1\n1\n3\n", "turbine.txt:4: a column is 3; it must be a whole number from 1 to 2");
  expect_refused("1 2\n1 1\n2\n1", "turbine.txt:4: ends where a column should be");
  expect_refused("1 9999\n1 1\n",
                 "turbine.txt:1: the number of columns is 9999; it must be a whole number from 0 to 11");
  expect_refused(
      "1 1\n1\n1 1\nshares 1",
      "turbine.txt:4: `shares` is no part of a cover problem; share, weights, demands, group_costs or "
      "groups may follow its rows");
}

}  // namespace
}  // namespace asterism
