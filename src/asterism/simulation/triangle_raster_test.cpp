// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/triangle_raster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

constexpr int kSize = 64;
const Lens kLens{1000, 1000, 0, 31.5, 31.5, {}, 0, 64, 64};

/// A fan of triangles around the optical axis at 1 m: its corners are at these places of the image.
DrawnSurface fan(const std::vector<Vec2>& corners) {
  TriangleMesh mesh;
  for (const Vec2& px : corners) mesh.vertices.emplace_back(px.x() - 31.5, px.y() - 31.5, 1000);
  for (std::uint32_t i = 2; i < corners.size(); ++i) mesh.triangles.push_back({0, i, i - 1});
  return drawn_surface(mesh, -1, 0.5, 0);
}

std::vector<float> shares_of(const DrawnSurface& surface, int samples) {
  std::vector<ScreenTriangle> triangles;
  add_screen_triangles(surface, {}, kLens, triangles);
  SampledTile tile(0, 0, kSize, samples);
  for (std::size_t i = 0; i < triangles.size(); ++i) tile.draw(triangles[i], static_cast<std::int32_t>(i));
  std::vector<float> light(kSize * kSize, 0.0F), share(kSize * kSize, 0.0F);
  tile.add_light(triangles, 0, 1, light, share);
  return share;
}

double sum_of(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(SampledTile, CoversAsMuchAsATriangleHas) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    RandomStream random(3, i);
    std::vector<Vec2> corners;
    for (int k = 0; k < 3; ++k) corners.push_back(Vec2{random.uniform(2, 61), random.uniform(2, 61)});
    const Vec2 along = corners[1] - corners[0], across = corners[2] - corners[0];
    const double area = 0.5 * std::abs(along.x() * across.y() - along.y() * across.x());
    const double around = along.norm() + across.norm() + (across - along).norm();
    // Each px of the rim adds an error of some 0.15 px², either way.
    EXPECT_NEAR(sum_of(shares_of(fan(corners), 4)), area, 0.5 * std::sqrt(around) + 0.5);
  }
}

TEST(SampledTile, LeavesNoGapAndNoOverlapBetweenNeighbours) {
  // However a square is cut up into triangles, each sample inside is covered and none outside.
  for (const int samples : {1, 4}) {
    const auto whole = shares_of(fan({{10.3, 12.1}, {50.3, 12.1}, {50.3, 55.7}, {10.3, 55.7}}), samples);
    for (std::uint64_t i = 0; i < 30; ++i) {
      RandomStream random(5, i);
      const Vec2 middle{random.uniform(11, 50), random.uniform(13, 55)};
      const auto cut = shares_of(
          fan({middle, {10.3, 12.1}, {50.3, 12.1}, {50.3, 55.7}, {10.3, 55.7}, {10.3, 12.1}}), samples);
      EXPECT_EQ(cut, whole);
    }
  }
}

TEST(AddScreenTriangles, LeavesOutTheBackOfAClosedSurfaceAndWhatReachesBehindTheCamera) {
  const TriangleMesh ball = surface_of_revolution({{0, -5}, {5, 0}, {0, 5}}, 24);
  std::vector<ScreenTriangle> triangles;
  add_screen_triangles(drawn_surface(ball, -1, 0.5, 0), {Quaternion::Identity(), {0, 0, 1000}}, kLens,
                       triangles);
  EXPECT_EQ(triangles.size(), 24U);  // of 48
  triangles.clear();
  add_screen_triangles(drawn_surface(ball, -1, 0.5, 0), {Quaternion::Identity(), {0, 0, 2}}, kLens,
                       triangles);
  EXPECT_TRUE(triangles.empty());
}

TEST(DrawnSurface, RoundsACylinderAndKeepsTheEdgesOfItsEnds) {
  const DrawnSurface drawn =
      drawn_surface(surface_of_revolution({{0, 0}, {10, 0}, {10, 40}, {0, 40}}, 36), -1, 0.5, 0);
  EXPECT_TRUE(drawn.closed);
  for (const DrawnSurface::Triangle& triangle : drawn.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& place = drawn.places[triangle.corner[k]];
      const Vec3& normal = triangle.normal[k];
      if (std::abs(normal.z()) > 0.5) {
        EXPECT_NEAR(std::abs(normal.z()), 1, 1e-12);
      } else if (place.head<2>().norm() > 1) {
        // Along the radius, but for neighbours whose areas are split unevenly: less than half a facet.
        EXPECT_GT(normal.head<2>().dot(place.head<2>().normalized()), std::cos(rad_from_deg(5)));
      }
    }
  }
}

TEST(DrawnSurface, IsDividedUntilNoEdgeIsTooLongAndStaysClosed) {
  const TriangleMesh bar = surface_of_revolution({{0, 0}, {10, 0}, {10, 400}, {0, 400}}, 12);
  const DrawnSurface drawn = drawn_surface(bar, -1, 0.5, 30);
  TriangleMesh divided;
  divided.vertices = drawn.places;
  for (const auto& triangle : drawn.triangles) {
    divided.triangles.push_back(triangle.corner);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE((drawn.places[triangle.corner[k]] - drawn.places[triangle.corner[(k + 1) % 3]]).norm(), 30);
  }
  EXPECT_TRUE(facts_of(divided).closed());
  EXPECT_NEAR(facts_of(divided).area_mm2 / facts_of(bar).area_mm2, 1, 1e-12);
}

}  // namespace
}  // namespace asterism
