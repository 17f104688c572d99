// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/deviation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

TriangleMesh plate() {
  return {{{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh sphere(double radius, int steps) {
  std::vector<ProfilePoint> arc;
  for (int i = 0; i <= steps; ++i) {
    const double up = -std::numbers::pi / 2 + std::numbers::pi * i / steps;
    arc.push_back({i == 0 || i == steps ? 0 : radius * std::cos(up), radius * std::sin(up)});
  }
  return surface_of_revolution(arc, 2 * steps);
}

Vec3 direction(RandomStream& random) {
  return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

/// Points over the plate whose heights are as a normal law has them.
Cloud noisy_plate(std::size_t count, double mean_mm, double sigma_mm, std::uint64_t seed) {
  Cloud cloud;
  RandomStream random(seed, 0);
  for (std::size_t i = 0; i < count; ++i) {
    cloud.points.emplace_back(90 * (random.uniform() - 0.5), 90 * (random.uniform() - 0.5),
                              mean_mm + sigma_mm * random.normal());
  }
  return cloud;
}

TEST(Deviation, OfASphereATenthLargerIsATenth) {
  Cloud cloud;
  RandomStream random(1, 0);
  for (int i = 0; i < 20000; ++i) cloud.points.push_back(50.1 * direction(random));
  const SurfaceTree tree(sphere(50, 150));
  const Deviation found = deviation_of(cloud, tree, {}, {});
  // The mesh lies within the sphere by 5.5 µm at most (2 R (1 − cos(π/300))).
  EXPECT_NEAR(found.whole.mean_mm, 0.1, 0.0055);
  EXPECT_NEAR(found.whole.median_mm, 0.1, 0.0055);
  EXPECT_LT(found.whole.sigma_mm, 0.0055 / 2);
  EXPECT_GE(found.whole.lowest_mm, 0.1 - 1e-9);
  EXPECT_EQ(found.whole.points, 20000U);
  Cloud smaller = cloud;
  for (Vec3& point : smaller.points) point *= 49.9 / 50.1;
  EXPECT_NEAR(deviation_of(smaller, tree, {}, {}).whole.mean_mm, -0.1, 0.0055);
}

TEST(Deviation, OfAPlateMovedAsideIsHowFar) {
  const Cloud cloud = noisy_plate(1000, -0.07, 0, 2);
  const Deviation found = deviation_of(cloud, SurfaceTree(plate()), {}, {});
  EXPECT_NEAR(found.whole.mean_mm, -0.07, 1e-12);
  EXPECT_NEAR(found.whole.rms_mm, 0.07, 1e-12);
  EXPECT_NEAR(found.whole.sigma_mm, 0, 1e-7);  // a difference of squares loses half of 16 digits
  EXPECT_EQ(found.whole.in_tolerance, 1);
  for (const double mm : found.mm) EXPECT_NEAR(mm, -0.07, 1e-12);
}

TEST(Deviation, HasTheSpreadAndThePercentilesOfTheNoise) {
  Cloud cloud = noisy_plate(40000, 0.02, 0.05, 3);
  cloud.fields.push_back({"sigma_mm", std::vector<double>(cloud.size(), 0.06)});
  const Deviation found = deviation_of(cloud, SurfaceTree(plate()), {}, {});
  const Summary exact = summarize(found.mm);
  EXPECT_NEAR(found.whole.mean_mm, exact.mean, 1e-12);
  EXPECT_NEAR(found.whole.sigma_mm, exact.deviation, 1e-6);  // n instead of n − 1
  // Within a bin of the fine histogram, 10 mm / 65536.
  EXPECT_NEAR(found.whole.p05_mm, quantile_of(found.mm, 0.05), 0.00016);
  EXPECT_NEAR(found.whole.median_mm, quantile_of(found.mm, 0.5), 0.00016);
  EXPECT_NEAR(found.whole.p95_mm, quantile_of(found.mm, 0.95), 0.00016);
  EXPECT_EQ(found.whole.lowest_mm, exact.lowest);
  EXPECT_EQ(found.whole.highest_mm, exact.highest);
  // Of a normal law with mean 0.02 and σ 0.05: Φ(−2.4) and 1 − Φ(1.6); four standard errors.
  EXPECT_NEAR(found.whole.below, 0.0082, 4 * std::sqrt(0.0082 / 40000));
  EXPECT_NEAR(found.whole.above, 0.0548, 4 * std::sqrt(0.0548 / 40000));
  EXPECT_NEAR(found.whole.below + found.whole.in_tolerance + found.whole.above, 1, 1e-12);
  EXPECT_NEAR(found.whole.predicted_rms_mm, 0.06, 1e-12);
  EXPECT_EQ(std::accumulate(found.histogram.begin(), found.histogram.end(), std::size_t{0}), 40000U);
  const auto top = std::max_element(found.histogram.begin(), found.histogram.end());
  const double top_mm = -0.5 + found.bin_mm * (static_cast<double>(top - found.histogram.begin()) + 0.5);
  EXPECT_NEAR(top_mm, 0.02, 2 * found.bin_mm);
}

TEST(Deviation, CountsWhatLiesTooFarOffAndLeavesItOut) {
  Cloud cloud = noisy_plate(100, 0.01, 0, 4);
  cloud.points.emplace_back(0, 0, 5.01);
  cloud.points.emplace_back(0, 0, -800);
  cloud.points.emplace_back(NAN, 0, 0);
  cloud.points.emplace_back(3, 0, 4.99);
  const Deviation found = deviation_of(cloud, SurfaceTree(plate()), {}, {});
  EXPECT_EQ(found.whole.beyond, 3U);
  EXPECT_EQ(found.whole.points, 101U);
  EXPECT_TRUE(std::isnan(found.mm[100]) && std::isnan(found.mm[101]) && std::isnan(found.mm[102]));
  EXPECT_NEAR(found.whole.highest_mm, 4.99, 1e-12);
  EXPECT_NEAR(found.whole.above, 1.0 / 101, 1e-12);
}

TEST(Deviation, TellsEachRegionByItself) {
  Cloud cloud = noisy_plate(4000, 0, 0, 5);
  for (Vec3& point : cloud.points) point.z() = point.x() > 0 ? 0.2 : -0.05;
  ScanRegion right{"right", Box{{50, 100, 10}}, {Quaternion::Identity(), {25, 0, 0}}};
  ScanRegion nowhere{"nowhere", Box{{1, 1, 1}}, {Quaternion::Identity(), {0, 0, 500}}};
  const std::vector<ScanRegion> regions = {right, nowhere};
  const Deviation found = deviation_of(cloud, SurfaceTree(plate()), regions, {});
  ASSERT_EQ(found.regions.size(), 2U);
  EXPECT_EQ(found.regions[0].region, "right");
  EXPECT_NEAR(found.regions[0].mean_mm, 0.2, 1e-12);
  EXPECT_EQ(found.regions[0].above, 1);
  EXPECT_GT(found.regions[0].points, 1800U);
  EXPECT_EQ(found.regions[1].points, 0U);
  EXPECT_LT(found.whole.mean_mm, 0.1);
}

TEST(Deviation, IsTheSameInPiecesAndOnAnyNumberOfThreads) {
  const Cloud cloud = noisy_plate(30000, 0.01, 0.04, 6);
  const SurfaceTree tree{plate()};
  set_thread_count(1);
  const Deviation whole = deviation_of(cloud, tree, {}, {});
  set_thread_count(3);
  DeviationCount count(tree, {}, {});
  std::vector<double> mm;
  for (std::size_t first = 0; first < cloud.size(); first += 9001) {
    Cloud piece;
    const std::size_t end = std::min(cloud.size(), first + 9001);
    for (std::size_t i = first; i < end; ++i) piece.points.push_back(cloud.points[i]);
    const std::vector<double> more = count.add(piece);
    mm.insert(mm.end(), more.begin(), more.end());
  }
  const Deviation pieces = count.finish();
  set_thread_count(0);
  EXPECT_EQ(mm, whole.mm);
  EXPECT_EQ(pieces.whole.mean_mm, whole.whole.mean_mm);
  EXPECT_EQ(pieces.whole.p95_mm, whole.whole.p95_mm);
  EXPECT_EQ(pieces.histogram, whole.histogram);
}

TEST(Deviation, OfNothingIsNothing) {
  const Deviation found = deviation_of({}, SurfaceTree(plate()), {}, {});
  EXPECT_EQ(found.whole.points, 0U);
  EXPECT_EQ(found.whole.rms_mm, 0);
  EXPECT_EQ(found.histogram.size(), 61U);
}

TEST(Deviation, BecomesAFieldOfTheCloudOnce) {
  Cloud cloud = noisy_plate(3, 0, 0, 7);
  add_deviation(cloud, {1, 2, 3});
  add_deviation(cloud, {4, 5, 6});
  ASSERT_EQ(cloud.fields.size(), 1U);
  EXPECT_EQ(*cloud.field("deviation_mm"), (std::vector<double>{4, 5, 6}));
  EXPECT_THROW(add_deviation(cloud, {1}), ContractViolation);
}

}  // namespace
}  // namespace asterism
