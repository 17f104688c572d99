// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "asterism/core/result.hpp"
#include "asterism/geometry/rays_for_tests.hpp"

namespace asterism {
namespace {

/// All points by distance, of equally far ones the first first.
std::vector<std::size_t> by_distance(const std::vector<Vec3>& points, const Vec3& place) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (points[a] - place).squaredNorm() < (points[b] - place).squaredNorm();
  });
  return order;
}

TEST(Neighbours, FindsWhatLookingAtEachPointFinds) {
  RandomStream random(1, 0);
  std::vector<Vec3> points;
  for (int i = 0; i < 700; ++i) points.push_back(rays::in_box(random, 100));
  const Neighbours tree(points);
  for (int i = 0; i < 300; ++i) {
    const Vec3 place = rays::in_box(random, 130);
    const auto order = by_distance(points, place);
    EXPECT_EQ(tree.nearest(place, std::numeric_limits<double>::infinity()), order[0]);
    const auto some = tree.few_nearest(place, 9);
    EXPECT_TRUE(std::equal(some.begin(), some.end(), order.begin(), order.begin() + 9));
    const auto near = tree.within(place, 25);
    const auto far = std::find_if(order.begin(), order.end(),
                                  [&](std::size_t p) { return (points[p] - place).norm() > 25; });
    EXPECT_EQ(near, std::vector<std::size_t>(order.begin(), far));
    EXPECT_EQ(tree.nearest(place, 25).has_value(), !near.empty());
  }
}

TEST(Neighbours, CountsWhatIsJustAsFarAndTheFirstOfEqualOnes) {
  std::vector<Vec3> points(40, Vec3(5, 0, 0));  // more than a leaf of the tree holds
  points.emplace_back(0, 3, 0);
  points.insert(points.begin(), Vec3(0, 0, -3));
  const Neighbours tree(points);
  EXPECT_EQ(tree.nearest({0, 0, 0}, 3), 0U);
  EXPECT_EQ(tree.within({0, 0, 0}, 3), (std::vector<std::size_t>{0, 41}));
  EXPECT_EQ(tree.nearest({5, 0, 0}, 0), 1U);
  EXPECT_EQ(tree.few_nearest({5, 0, 0}, 3), (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(tree.within({5, 0, 0}, 0).size(), 40U);
}

TEST(Neighbours, FindsNothingAmongNoneOrTooFarAway) {
  const Neighbours none(std::vector<Vec3>{});
  EXPECT_FALSE(none.nearest({0, 0, 0}, 1e9).has_value());
  EXPECT_TRUE(none.within({0, 0, 0}, 1e9).empty());
  EXPECT_TRUE(none.few_nearest({0, 0, 0}, 3).empty());
  const Neighbours one(std::vector<Vec3>{{1, 2, 3}});
  EXPECT_FALSE(one.nearest({1, 2, 4}, 0.999).has_value());
  EXPECT_EQ(one.few_nearest({1, 2, 4}, 3), std::vector<std::size_t>{0});
  EXPECT_TRUE(one.few_nearest({1, 2, 4}, 0).empty());
  EXPECT_THROW((void)one.within({0, 0, 0}, -1), ContractViolation);
}

TEST(Neighbours, KeepsThePointsItWasGiven) {
  std::vector<Vec3> points = {{1, 0, 0}, {2, 0, 0}};
  const Neighbours tree(points);
  points.clear();
  points.shrink_to_fit();
  EXPECT_EQ(tree.nearest({3, 0, 0}, 10), 1U);
}

}  // namespace
}  // namespace asterism
