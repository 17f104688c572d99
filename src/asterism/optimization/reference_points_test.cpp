// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/reference_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

TEST(ReferenceDirections, AreAsManyAsDebAndJainList) {
  EXPECT_EQ(reference_directions(3, 91).size() / 3, 91U);
  EXPECT_EQ(reference_directions(5, 210).size() / 5, 210U);
  EXPECT_EQ(reference_directions(8, 156).size() / 8, 156U);
  EXPECT_EQ(reference_directions(10, 275).size() / 10, 275U);
  EXPECT_EQ(reference_directions(2, 100).size() / 2, 100U);
  EXPECT_EQ(reference_directions(4, 100).size() / 4, 84U);
  EXPECT_EQ(reference_directions(6, 2).size() / 6, 6U);  // the axes are the least
}

TEST(ReferenceDirections, AreUnitVectorsAllDifferentAndNoneNegative) {
  for (const std::size_t m : {2, 3, 5, 8}) {
    const auto directions = reference_directions(m, 120);
    std::set<std::vector<double>> different;
    for (std::size_t i = 0; i < directions.size(); i += m) {
      double norm = 0;
      for (std::size_t k = 0; k < m; ++k) {
        norm += directions[i + k] * directions[i + k];
        EXPECT_GE(directions[i + k], 0);
      }
      EXPECT_NEAR(norm, 1, 1e-14);
      different.emplace(&directions[i], &directions[i] + m);
    }
    EXPECT_EQ(different.size(), directions.size() / m);
  }
}

/// Several candidates near each direction, on a sphere with its middle at the ideal point.
std::vector<double> crowds(std::size_t m, std::size_t directions_wanted, std::size_t each, double spread) {
  const auto directions = reference_directions(m, directions_wanted);
  RandomStream random(127, m);
  std::vector<double> points;
  for (std::size_t d = 0; d < directions.size(); d += m)
    for (std::size_t copy = 0; copy < each; ++copy) {
      std::vector<double> point(m);
      double norm = 0;
      for (std::size_t k = 0; k < m; ++k) {
        point[k] = directions[d + k] + (copy == 0 || directions[d + k] == 0 ? 0 : spread * random.uniform());
        norm += point[k] * point[k];
      }
      for (std::size_t k = 0; k < m; ++k) points.push_back(point[k] / std::sqrt(norm));
    }
  return points;
}

TEST(ReferencePointNiching, KeepsTheNearestOfEachDirection) {
  for (const std::size_t m : {3, 4, 5}) {
    const std::size_t wanted = reference_directions(m, 60).size() / m;
    const auto points = crowds(m, 60, 4, 0.02);
    NonDominatedSort sort;
    ReferencePointNiching niching;
    // One front by construction; the sort tells its order.
    const Fronts& fronts = sort(points, m);
    const auto chosen = niching(points, m, fronts, 0, std::min(wanted, fronts.front(0).size()), wanted);
    std::size_t nearest = 0;
    for (const std::uint32_t at : chosen) nearest += fronts.front(0)[at] % 4 == 0 ? 1 : 0;
    EXPECT_GE(nearest, wanted - m) << "m " << m;  // axes may share their point with copies of it
  }
}

TEST(ReferencePointNiching, DoesNotDependOnTheUnitsOfTheObjectives) {
  const std::size_t m = 4;
  auto points = crowds(m, 60, 5, 0.1);
  NonDominatedSort sort;
  ReferencePointNiching niching;
  const auto first = niching(points, m, sort(points, m), 0, 30, 60);
  const std::vector<std::uint32_t> before(first.begin(), first.end());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] *= std::pow(2.0, 3.0 * static_cast<double>(i % m));
  const auto second = niching(points, m, sort(points, m), 0, 30, 60);
  EXPECT_EQ(before, std::vector<std::uint32_t>(second.begin(), second.end()));
}

TEST(ReferencePointNiching, ServesFirstWhomEarlierFrontsDoNot) {
  // Front 0 holds the three ends; of front 1 the one between two ends is wanted, not one beside an end.
  const std::vector<double> points = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1.1, 0.05, 0.05, 1, 1, 0.02};
  NonDominatedSort sort;
  const Fronts& fronts = sort(points, 3);
  ASSERT_EQ(fronts.rank, (std::vector{0, 0, 0, 1, 1}));
  ReferencePointNiching niching;
  const auto chosen = niching(points, 3, fronts, 1, 1, 6);
  ASSERT_EQ(chosen.size(), 1U);
  EXPECT_EQ(fronts.front(1)[chosen[0]], 4U);
}

TEST(ReferencePointNiching, StandsFlatObjectives) {
  const std::vector<double> points = {0, 1, 5, 5, 1, 0, 5, 5, 0.5, 0.5, 5, 5};
  NonDominatedSort sort;
  ReferencePointNiching niching;
  EXPECT_EQ(niching(points, 4, sort(points, 4), 0, 2, 10).size(), 2U);
  const std::vector<double> copies(20, 3.0);
  EXPECT_EQ(niching(copies, 4, sort(copies, 4), 0, 3, 10).size(), 3U);
}

}  // namespace
}  // namespace asterism
