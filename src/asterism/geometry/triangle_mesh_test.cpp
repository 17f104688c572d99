// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Area of a regular polygon of so many sides over that of its circumscribed circle.
double share_of_circle(int sides) {
  const double step = 2 * std::numbers::pi / sides;
  return std::sin(step) / step;
}

TEST(FactsOf, KnowsACube) {
  const MeshFacts facts = facts_of(moved(scaled(cube(), 3), {exp_rotation({0.3, 1, -2}), {900, 50, 2000}}));
  EXPECT_TRUE(facts.closed());
  EXPECT_EQ(facts.triangles, 12U);
  EXPECT_NEAR(facts.area_mm2, 54, 1e-9);  // digits of 2000 mm
  EXPECT_NEAR(facts.volume_mm3, 27, 1e-9);
  EXPECT_NEAR(facts_of(cube()).diagonal_mm(), std::sqrt(3), 1e-15);
}

TEST(FactsOf, CountsTheEdgesOfAnOpenSurface) {
  TriangleMesh mesh = cube();
  mesh.triangles.pop_back();
  const MeshFacts facts = facts_of(mesh);
  EXPECT_FALSE(facts.closed());
  EXPECT_EQ(facts.boundary_edges, 3U);
  EXPECT_EQ(facts.non_manifold_edges + facts.flipped_edges, 0U);
}

TEST(FactsOf, CountsTheEdgesOfATriangleThatFacesTheOtherWay) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[5][1], mesh.triangles[5][2]);
  const MeshFacts facts = facts_of(mesh);
  EXPECT_EQ(facts.flipped_edges, 3U);
  EXPECT_EQ(facts.boundary_edges, 0U);
  EXPECT_FALSE(facts.closed());
}

TEST(FactsOf, CountsAnEdgeOfThreeTriangles) {
  TriangleMesh mesh = cube();
  mesh.vertices.emplace_back(-1, -1, 0.5);
  mesh.triangles.push_back({0, 4, 8});  // a fin on an edge
  const MeshFacts facts = facts_of(mesh);
  EXPECT_EQ(facts.non_manifold_edges, 1U);
  EXPECT_EQ(facts.boundary_edges, 2U);
}

TEST(FactsOf, LetsATriangleThatIsALineStandBesideItsNeighbours) {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({0, 0, 1});
  const MeshFacts facts = facts_of(mesh);
  EXPECT_EQ(facts.degenerate, 1U);
  EXPECT_TRUE(facts.closed());
}

TEST(FactsOf, KnowsNothingOfAnEmptySurface) {
  EXPECT_FALSE(facts_of({}).closed());
  EXPECT_EQ(facts_of({}).diagonal_mm(), 0);
}

TEST(Flipped, TurnsTheVolumesSign) {
  EXPECT_NEAR(facts_of(flipped(cube())).volume_mm3, -1, 1e-15);
  EXPECT_TRUE(facts_of(flipped(cube())).closed());
}

TEST(Welded, MakesSoupOfTrianglesClosed) {
  TriangleMesh soup;
  const TriangleMesh whole = cube();
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(whole.corner(t, k));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  soup.vertices[0].x() = -0.0;  // the same place as 0
  EXPECT_EQ(facts_of(soup).boundary_edges, 36U);
  EXPECT_EQ(welded(soup).vertices.size(), 8U);
  EXPECT_TRUE(facts_of(welded(soup)).closed());
}

TEST(Append, KeepsBothSurfaces) {
  TriangleMesh both = cube();
  append(both, moved(cube(), {Quaternion::Identity(), {5, 0, 0}}));
  const MeshFacts facts = facts_of(both);
  EXPECT_TRUE(facts.closed());
  EXPECT_NEAR(facts.volume_mm3, 2, 1e-14);
  EXPECT_EQ(facts.highest.x(), 6);
}

TEST(SurfaceOfRevolution, IsAClosedTubeOfTheRightVolumeAndArea) {
  constexpr int kSides = 200;
  const double pi = std::numbers::pi;
  const MeshFacts facts = facts_of(surface_of_revolution({{10, 0}, {10, 40}, {8, 40}, {8, 0}}, kSides));
  EXPECT_TRUE(facts.closed());
  // A prism over a polygon: exact but for rounding.
  EXPECT_NEAR(facts.volume_mm3, pi * (100 - 64) * 40 * share_of_circle(kSides), 1e-8);
  const double side = 2 * kSides * std::sin(pi / kSides) * (10 + 8) * 40;
  EXPECT_NEAR(facts.area_mm2, side + 2 * pi * (100 - 64) * share_of_circle(kSides), 1e-8);
}

TEST(SurfaceOfRevolution, IsAClosedConeWithATip) {
  const MeshFacts facts = facts_of(surface_of_revolution({{0, 0}, {6, 0}, {0, 9}}, 90));
  EXPECT_TRUE(facts.closed());
  EXPECT_EQ(facts.degenerate, 0U);
  EXPECT_EQ(facts.triangles, 180U);
  EXPECT_NEAR(facts.volume_mm3, std::numbers::pi * 36 * 9 / 3 * share_of_circle(90), 1e-10);
}

TEST(SurfaceOfRevolution, NeedsAProfile) {
  EXPECT_THROW(static_cast<void>(surface_of_revolution({{1, 0}}, 10)), ContractViolation);
  EXPECT_THROW(static_cast<void>(scaled(cube(), -1)), ContractViolation);
}

}  // namespace
}  // namespace asterism
