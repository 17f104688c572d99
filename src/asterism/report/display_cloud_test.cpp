// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/display_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A square of side × side points 1 mm apart, seen from above.
Cloud square(int side, double z_mm = 0, float up = 1) {
  Cloud cloud;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      cloud.points.emplace_back(x, y, z_mm);
      cloud.normals.emplace_back(0, 0, up);
    }
  }
  return cloud;
}

Cloud both(Cloud cloud, const Cloud& other) {
  cloud.points.insert(cloud.points.end(), other.points.begin(), other.points.end());
  cloud.normals.insert(cloud.normals.end(), other.normals.begin(), other.normals.end());
  return cloud;
}

TEST(ThinnedCloud, IsWholeWhenItIsSmallEnough) {
  const DisplayCloud drawn = thinned(square(10), 100);
  EXPECT_EQ(drawn.points.size(), 100U);
  EXPECT_EQ(drawn.voxel_mm, 0);
}

TEST(ThinnedCloud, KeepsNearlyAsManyAsAllowedEvenlySpread) {
  const Cloud cloud = square(200);
  const DisplayCloud drawn = thinned(cloud, 2500);
  EXPECT_LE(drawn.points.size(), 2500U);
  EXPECT_GE(drawn.points.size(), 1600U);  // the grid's cubes need not fit the points' own
  std::vector<int> quarters(4, 0);
  for (const std::uint32_t i : drawn.points)
    ++quarters[static_cast<std::size_t>(2 * (cloud.points[i].x() >= 100) + (cloud.points[i].y() >= 100))];
  for (const int count : quarters) EXPECT_NEAR(count, drawn.points.size() / 4.0, 0.1 * 2500);
  EXPECT_TRUE(std::is_sorted(drawn.points.begin(), drawn.points.end()));
}

TEST(ThinnedCloud, KeepsBothSidesOfAThinWall) {
  const Cloud cloud = both(square(60, 0, 1), square(60, 0.5, -1));
  const DisplayCloud drawn = thinned(cloud, 400);
  std::size_t under = 0;
  for (const std::uint32_t i : drawn.points) under += i >= 3600 ? 1 : 0;
  EXPECT_EQ(2 * under, drawn.points.size());
}

TEST(ThinnedCloud, LeavesOutWhatIsNotFinite) {
  Cloud cloud = square(5);
  cloud.points[3].y() = kNone;
  const DisplayCloud drawn = thinned(cloud, 100);
  EXPECT_EQ(drawn.points.size(), 24U);
  EXPECT_EQ(std::set<std::uint32_t>(drawn.points.begin(), drawn.points.end()).count(3), 0U);
}

TEST(ThinnedCloud, ComesToAnEndWhenAllPointsAreOne) {
  Cloud cloud;
  cloud.points.assign(1000, Vec3(1, 2, 3));
  EXPECT_EQ(thinned(cloud, 10).points.size(), 1U);
  EXPECT_TRUE(thinned(Cloud{}, 10).points.empty());
}

TEST(PackedPlaces, ComeBackWithinHalfAStep) {
  Cloud cloud;
  cloud.points = {{-450.123, 10, 0}, {449.9, 12.5, 600.7}, {0, 11, 300}};
  const PackedPlaces packed = packed_places(cloud, {0, 1, 2});
  EXPECT_NEAR(packed.step_mm, 900.023 / 65535, 1e-9);
  for (std::size_t i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(packed.low[axis] + packed.step_mm * packed.steps[3 * i + static_cast<std::size_t>(axis)],
                  cloud.points[i][axis], 0.501 * packed.step_mm);
}

TEST(PackedReals, AreHalfFloatsAndSayNothingForNone) {
  const std::vector<double> values = {1, -2, 0.1, kNone, 1e9, std::numeric_limits<double>::infinity()};
  // 1 and −2 are exact; 0.1 = 1.6 / 16: exponent 11, mantissa 0.6 of 1024.
  const std::vector<std::uint16_t> packed = {0x3c00, 0xc000, 0x2e66, 0x7e00, 0x7e00, 0x7e00};
  EXPECT_EQ(packed_reals(values, {0, 1, 2, 3, 4, 5}), packed);
}

TEST(PackedCounts, AreWholeAndSayNothingForNone) {
  const std::vector<double> values = {0, 7, 1e6, -1, kNone};
  EXPECT_EQ(packed_counts(values, {0, 1, 2, 3, 4}), (std::vector<std::uint16_t>{0, 7, 65534, 65535, 65535}));
  EXPECT_EQ(packed_counts(values, {1}), std::vector<std::uint16_t>{7});
}

}  // namespace
}  // namespace asterism
