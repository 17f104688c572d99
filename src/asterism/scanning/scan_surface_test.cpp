// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/scan_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"

namespace asterism {
namespace {

/// A ball of 100 mm radius 300 mm ahead, on a grid of 2.5 mm, with the scanner's noise; each 97th point
/// an outlier along the line of sight.
Scan ball(bool outliers, double noise = 1) {
  Scan scan;
  const Scanner scanner;
  for (int row = 0; row < 50; ++row) {
    for (int column = 0; column < 50; ++column) {
      const double x = 2.5 * (column - 25), y = 2.5 * (row - 25);
      const double z = 400 - std::sqrt(100 * 100 - x * x - y * y);
      const Vec3 at(x, y, z);
      const Vec3 normal = (at - Vec3(0, 0, 400)).normalized();
      RandomStream random(2, scan.in_scanner.size());
      const RangeNoise sigma = range_noise(scanner, z, std::abs(normal.dot(at)) / at.norm());
      Vec3 seen = at + noise * Vec3(sigma.lateral_mm * random.normal(), sigma.lateral_mm * random.normal(),
                                    sigma.depth_mm * random.normal());
      if (outliers && scan.in_scanner.size() % 97 == 50)
        seen += at.normalized() * (random.uniform() < 0.5 ? -4 : 4);
      scan.in_scanner.push_back(seen.cast<float>());
    }
  }
  return scan;
}

TEST(SurfaceOf, FindsNormalsTowardsTheScanner) {
  const Scan scan = ball(false);
  const ScanSurface surface = surface_of(scan, Scanner{}, {});
  double worst = 0;
  for (std::size_t i = 0; i < scan.in_scanner.size(); ++i) {
    if (surface.normals[i].isZero()) continue;
    const Vec3f normal = (scan.in_scanner[i] - Vec3f(0, 0, 400)).normalized();
    worst = std::max(worst, std::acos(std::min(1.0, static_cast<double>(normal.dot(surface.normals[i])))));
  }
  // Noise of 0.03 mm over 3 mm, ten points: a third of a degree; at the grid's rim neighbours lie on one
  // side.
  EXPECT_LT(deg_from_rad(worst), 5);
  EXPECT_NEAR(surface.spacing_mm, 2.5, 0.2);
}

TEST(SurfaceOf, RefusesWhatLiesOffAndLetsTheRestBe) {
  const Scan scan = ball(true);
  const ScanSurface surface = surface_of(scan, Scanner{}, {});
  std::size_t missed = 0, wrong = 0;
  for (std::size_t i = 0; i < scan.in_scanner.size(); ++i) {
    const bool outlier = i % 97 == 50;
    missed += outlier && surface.outlier[i] == 0 ? 1 : 0;
    wrong += !outlier && surface.outlier[i] != 0 ? 1 : 0;
  }
  EXPECT_EQ(missed, 0u);
  EXPECT_LT(wrong, 8u);  // of 2,475: three in a thousand, for spreads of nine points are told badly
  const Scan clean = cleaned(scan, surface);
  EXPECT_EQ(clean.in_scanner.size(), scan.in_scanner.size() - surface.outliers);
  EXPECT_EQ(clean.normals.size(), clean.in_scanner.size());
}

TEST(SurfaceOf, TellsTheScannersNoise) {
  // 0.1 mm along the line of sight square on; up to 1.6 times as much along it at the rim, which is farther
  // and oblique.
  const double roughness_mm = surface_of(ball(true, 4), Scanner{}, {}).roughness_mm;
  EXPECT_GT(roughness_mm, 0.1);
  EXPECT_LT(roughness_mm, 0.16);
}

TEST(SurfaceOf, CallsAPointAloneAnOutlier) {
  Scan scan;
  scan.in_scanner = {Vec3f(0, 0, 300), Vec3f(1, 0, 300)};
  EXPECT_EQ(surface_of(scan, Scanner{}, {}).outliers, 2u);
  EXPECT_EQ(surface_of(Scan{}, Scanner{}, {}).normals.size(), 0u);
}

TEST(SurfaceOf, GivesTheSameBitsOnAnyNumberOfThreads) {
  set_thread_count(1);
  const ScanSurface one = surface_of(ball(true), Scanner{}, {});
  set_thread_count(3);
  const ScanSurface three = surface_of(ball(true), Scanner{}, {});
  set_thread_count(0);
  EXPECT_EQ(one.outlier, three.outlier);
  EXPECT_EQ(one.roughness_mm, three.roughness_mm);
  EXPECT_TRUE(one.normals == three.normals);
}

TEST(SeenFromOrigin, IsNotWhatLiesBehindIt) {
  Scan scan = ball(false);
  EXPECT_TRUE(seen_from_origin(scan));
  for (Vec3f& point : scan.in_scanner) point.z() -= 330;
  EXPECT_FALSE(seen_from_origin(scan));
}

}  // namespace
}  // namespace asterism
