// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/knee.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// y = 1/x from 0.02 to 50: a front with a knee at (1, 1).
std::vector<double> hyperbola() {
  std::vector<double> front;
  for (int i = -100; i <= 100; ++i) {
    const double x = std::pow(50.0, i / 100.0);
    front.insert(front.end(), {x, 1 / x});
  }
  return front;
}

TEST(KneeOf, IsWhereTheFrontBends) {
  const auto front = hyperbola();
  const std::size_t knee = knee_of(front, 2);
  EXPECT_NEAR(front[2 * knee], 1, 0.05);
}

TEST(KneeOf, DoesNotDependOnUnits) {
  auto front = hyperbola();
  const std::size_t before = knee_of(front, 2);
  for (std::size_t i = 1; i < front.size(); i += 2) front[i] = 1000 * front[i] - 7;
  EXPECT_EQ(knee_of(front, 2), before);
}

TEST(KneeOf, TakesAFrontOfOneAndFlatObjectives) {
  EXPECT_EQ(knee_of(std::vector<double>{3, 4}, 2), 0U);
  EXPECT_EQ(knee_of(std::vector<double>{3, 4, 2, 4}, 2), 1U);
  EXPECT_THROW((void)knee_of({}, 2), ContractViolation);
}

TEST(Thinned, KeepsTheKneeTheExtremesAndTheSpread) {
  const auto front = hyperbola();
  const auto chosen = thinned(front, 2, 20);
  ASSERT_EQ(chosen.size(), 20U);
  EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
  const auto has = [&](std::size_t i) { return std::find(chosen.begin(), chosen.end(), i) != chosen.end(); };
  EXPECT_TRUE(has(0));
  EXPECT_TRUE(has(200));
  EXPECT_TRUE(has(knee_of(front, 2)));
}

TEST(Thinned, GivesAllWhenThereIsRoomAndDuplicatesOnce) {
  EXPECT_EQ(thinned(std::vector<double>{1, 3, 2, 2, 3, 1}, 2, 10).size(), 3U);
  EXPECT_EQ(thinned(std::vector<double>{1, 3, 1, 3, 3, 1}, 2, 10).size(), 2U);
  EXPECT_TRUE(thinned({}, 2, 10).empty());
}

}  // namespace
}  // namespace asterism
