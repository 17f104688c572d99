// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/surface_samples.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kPi = std::numbers::pi;

TriangleMesh drum() { return surface_of_revolution({{0, 0}, {100, 0}, {100, 300}, {0, 300}}, 180); }

TEST(SampleSurface, SpreadsPlacesByArea) {
  const auto samples = sample_surface(drum(), 4000, {}, 7);
  double side = 0, whole = 0;
  for (const SurfaceSample& sample : samples) {
    whole += sample.area_mm2;
    if (std::abs(sample.normal.z()) < 0.5) side += sample.area_mm2;
    EXPECT_LE(std::hypot(sample.at.x(), sample.at.y()), 100 + 1e-9);
  }
  // Of a drum 2 π r h + 2 π r²; a polygon of 180 sides has 0.03 % less.
  EXPECT_NEAR(whole, 2 * kPi * 100 * 400, 1e-3 * whole);
  // Strips of equal area leave an error only where a strip crosses a rim.
  EXPECT_NEAR(side / whole, 0.75, 0.01);
}

TEST(SampleSurface, LeavesNoPartOfALargeTriangleOut) {
  TriangleMesh plate;
  plate.vertices = {{0, 0, 0}, {1000, 0, 0}, {1000, 1000, 0}, {0, 1000, 0}};
  plate.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::array<int, 16> places{};
  for (const SurfaceSample& sample : sample_surface(plate, 1600, {}, 3)) {
    EXPECT_NEAR(sample.at.z(), 0, 1e-12);
    EXPECT_NEAR(sample.normal.z(), 1, 1e-12);
    const auto column = static_cast<std::size_t>(sample.at.x() / 250);
    const auto row = static_cast<std::size_t>(sample.at.y() / 250);
    ++places[std::min<std::size_t>(column, 3) + 4 * std::min<std::size_t>(row, 3)];
  }
  // 100 expected in each; were each at random anywhere, four standard deviations would be 39.
  for (const int count : places) EXPECT_NEAR(count, 100, 39);
}

TEST(SampleSurface, TakesTheWeightOfTheLaterRegion) {
  const std::vector<ScanRegion> regions = {
      {"upper half", Box{{400, 400, 300}}, {Quaternion::Identity(), {0, 0, 300}}, 3},
      {"top", Box{{400, 400, 20}}, {Quaternion::Identity(), {0, 0, 300}}, 0}};
  for (const SurfaceSample& sample : sample_surface(drum(), 500, regions, 1)) {
    const double expected = sample.at.z() > 290 ? 0 : sample.at.z() > 150 ? 3 : 1;
    EXPECT_EQ(sample.weight, expected) << sample.at.z();
  }
}

TEST(SampleSurface, GivesOtherPlacesForAnotherSeedOnly) {
  const auto one = sample_surface(drum(), 50, {}, 1), same = sample_surface(drum(), 50, {}, 1);
  const auto other = sample_surface(drum(), 50, {}, 2);
  EXPECT_EQ(one[17].at, same[17].at);
  EXPECT_NE(one[17].at, other[17].at);
}

TEST(SampleSurface, RefusesASurfaceWithoutArea) {
  TriangleMesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.triangles = {{0, 1, 2}};
  EXPECT_THROW(static_cast<void>(sample_surface(line, 10, {}, 1)), InputError);
}

}  // namespace
}  // namespace asterism
