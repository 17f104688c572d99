// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/occluders.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace asterism {
namespace {

constexpr double kPi = std::numbers::pi;
/// Share of a circle that a polygon of 96 sides on it holds, and twice as much room for a ball of both.
constexpr double kPolygon = 1e-3;

MeshFacts facts_of_shape(const Shape& shape) {
  const MeshFacts facts = facts_of(mesh_of(shape));
  EXPECT_TRUE(facts.closed());
  EXPECT_EQ(facts.degenerate, 0U);
  return facts;
}

TEST(MeshOfShape, IsABoxCentredOnItsOrigin) {
  const MeshFacts facts = facts_of_shape(Box{{10, 20, 30}});
  EXPECT_NEAR(facts.volume_mm3, 6000, 1e-9);
  EXPECT_EQ(facts.highest, Vec3(5, 10, 15));
  EXPECT_EQ(facts.lowest, Vec3(-5, -10, -15));
}

TEST(MeshOfShape, IsAFrustumFromItsOriginUp) {
  const MeshFacts facts = facts_of_shape(Frustum{30, 20, 50});
  EXPECT_NEAR(facts.volume_mm3 / (kPi * 50 / 3 * (900 + 600 + 400)), 1, kPolygon);
  EXPECT_EQ(facts.lowest.z(), 0);
  EXPECT_EQ(facts.highest.z(), 50);
  EXPECT_NEAR(facts_of_shape(Frustum{30, 0, 50}).volume_mm3 / (kPi * 900 * 50 / 3), 1, kPolygon);
  EXPECT_NEAR(facts_of_shape(Frustum{0, 30, 50}).volume_mm3 / (kPi * 900 * 50 / 3), 1, kPolygon);
}

TEST(MeshOfShape, IsACapsuleBetweenItsEnds) {
  const Vec3 from(10, -20, 30), to(70, 40, 0);
  const MeshFacts facts = facts_of_shape(Capsule{from, to, 7});
  const double volume = kPi * 49 * (to - from).norm() + 4.0 / 3 * kPi * 343;
  EXPECT_NEAR(facts.volume_mm3 / volume, 1, 2 * kPolygon);
  // Both ends lie within a ball around each end of the axis, and touch it.
  const Vec3 tip = to + 7 * (to - from).normalized();
  double nearest = 1e9;
  for (const Vec3& vertex : mesh_of(Capsule{from, to, 7}).vertices) {
    nearest = std::min(nearest, (vertex - tip).norm());
  }
  EXPECT_LT(nearest, 1e-9);
}

TEST(MeshOfShape, IsABallWhenACapsulesEndsAreOne) {
  const MeshFacts facts = facts_of_shape(Capsule{{1, 2, 3}, {1, 2, 3}, 10});
  EXPECT_NEAR(facts.volume_mm3 / (4.0 / 3 * kPi * 1000), 1, 2 * kPolygon);
}

TEST(OccludersOf, AreInTheFramesOfTheirCarriers) {
  Cell cell;
  cell.movers.push_back({{"platform", {}}, at_rest({})});
  cell.movers.push_back({{"scanner", {}}, at_rest({})});
  const auto box = std::make_shared<const TriangleMesh>(mesh_of(Box{{2, 2, 2}}));
  cell.workpiece = Solid{"part", box, "platform", {Quaternion::Identity(), {100, 0, 0}}, {}};
  cell.fixtures.push_back({"clamp", box, "", {exp_rotation({0, 0, kPi / 2}), {0, 50, 0}}, {}});
  cell.obstacles.push_back({"housing", Box{{4, 4, 4}}, "scanner", {}, {}});
  const std::vector<Occluder> all = occluders_of(cell);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].name, "part");
  EXPECT_EQ(all[0].carrier, 0);
  EXPECT_EQ(facts_of(all[0].surface).highest, Vec3(101, 1, 1));
  EXPECT_EQ(all[1].carrier, -1);
  EXPECT_LT((facts_of(all[1].surface).highest - Vec3(1, 51, 1)).norm(), 1e-12);
  EXPECT_EQ(all[2].carrier, 1);
}

}  // namespace
}  // namespace asterism
