// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/crowding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(CrowdingDistances, AreThoseOfThePapersTable10) {
  // Mean distance to the origin and minus the sum of pair distances of the schemes of Table 9.
  const std::vector<double> objectives = {661.4641,   -2663.1306, 778.7963,   -4780.4978, 850.5667,
                                          -5736.6551, 669.2338,   -3005.7685, 857.9556,   -5828.3542};
  const std::array front = {0, 1, 2, 3, 4};
  std::array<double, 5> distance{};
  crowding_distances(objectives, 2, front, distance);
  EXPECT_EQ(distance[0], kInfinite);
  EXPECT_NEAR(distance[1], 1.7856, 5e-5);
  EXPECT_NEAR(distance[2], 0.7339, 5e-5);
  EXPECT_NEAR(distance[3], 1.2661, 5e-5);
  EXPECT_EQ(distance[4], kInfinite);
}

TEST(CrowdingDistances, LeaveOutAnObjectiveThatIsTheSameForAll) {
  const std::vector<double> objectives = {0, 5, 0, 1, 5, 2, 3, 5, 0};
  const std::array front = {0, 1, 2};
  std::array<double, 3> distance{};
  crowding_distances(objectives, 3, front, distance);
  EXPECT_EQ(distance[0], kInfinite);
  EXPECT_EQ(distance[1], 1.0 + 0.0 + kInfinite);
  EXPECT_EQ(distance[2], kInfinite);

  const std::vector<double> equal(6, 7.0);
  crowding_distances(equal, 2, front, distance);
  EXPECT_EQ(distance, (std::array{0.0, 0.0, 0.0}));
}

TEST(CrowdingDistances, DoNotDependOnTheOrderOfThePoints) {
  for (const std::size_t m : {2, 3, 5}) {
    RandomStream random(43, m);
    std::vector<double> objectives(40 * m);
    for (double& x : objectives) x = random.below(12);
    std::vector<int> forwards, backwards;
    for (int i = 0; i < 40; ++i) {
      // Copies of a point are told apart by their index alone, so only one of each may take part.
      const auto point = [&](int j) {
        return std::span(objectives).subspan(static_cast<std::size_t>(j) * m, m);
      };
      bool copy = false;
      for (const int j : forwards) copy |= std::ranges::equal(point(i), point(j));
      if (!copy) forwards.push_back(i);
    }
    backwards.assign(forwards.rbegin(), forwards.rend());
    std::vector<double> distance(forwards.size()), reversed(forwards.size());
    crowding_distances(objectives, m, forwards, distance);
    crowding_distances(objectives, m, backwards, reversed);
    std::ranges::reverse(reversed);
    EXPECT_EQ(distance, reversed);
  }
}

}  // namespace
}  // namespace asterism
