// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/space_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/geometry/rays_for_tests.hpp"

namespace asterism {
namespace {

TEST(SpaceCurve, GoesThroughTheEightCornersOfACubeAsMortonsDoes) {
  std::vector<Vec3> corners;
  for (int i = 7; i >= 0; --i) corners.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  EXPECT_EQ(order_along_curve(corners, Vec3::Zero(), 1),
            (std::vector<std::uint32_t>{7, 6, 5, 4, 3, 2, 1, 0}));
}

TEST(SpaceCurve, KeepsNeighboursTogetherAndEachPlaceOnce) {
  RandomStream random(1, 0);
  std::vector<Vec3> places;
  for (int i = 0; i < 4000; ++i) places.push_back(rays::in_box(random, 500));
  std::vector<std::uint32_t> order = order_along_curve(places, Vec3::Constant(-500), 1000);
  double along = 0, before = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    along += (places[order[i]] - places[order[i - 1]]).norm();
    before += (places[i] - places[i - 1]).norm();
  }
  EXPECT_LT(along, before / 5);  // 660 mm between two at random, 60 mm from one to its next in a lattice
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
}

TEST(SpaceCurve, TakesPlacesOutsideAndWhatIsNoPlace) {
  const std::vector<Vec3> places = {{1e300, 5, 5}, {-9, -9, -9}, {NAN, NAN, NAN}, {0, 0, 0}};
  EXPECT_EQ(order_along_curve(places, Vec3::Zero(), 10), (std::vector<std::uint32_t>{1, 2, 3, 0}));
  EXPECT_TRUE(order_along_curve({}, Vec3::Zero(), 10).empty());
  EXPECT_THROW((void)order_along_curve(places, Vec3::Zero(), 0), ContractViolation);
}

}  // namespace
}  // namespace asterism
