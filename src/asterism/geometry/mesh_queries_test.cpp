// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/mesh_queries.hpp"

#include <gtest/gtest.h>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// A tube from z = 0 to 40, between radii 8 and 10.
TriangleMesh tube() { return surface_of_revolution({{10, 0}, {10, 40}, {8, 40}, {8, 0}}, 64); }

TEST(WindingNumber, IsOneInsideAndZeroOutside) {
  // 12 digits: a sum of 512 solid angles, each right to 16.
  EXPECT_NEAR(winding_number(tube(), {9, 0, 20}), 1, 1e-12);
  EXPECT_NEAR(winding_number(tube(), {0, 0, 20}), 0, 1e-12);  // in the opening is not in the wall
  EXPECT_NEAR(winding_number(tube(), {30, 5, 20}), 0, 1e-12);
  EXPECT_NEAR(winding_number(flipped(tube()), {9, 0, 20}), -1, 1e-12);
}

TEST(WindingNumber, IsWholeNowhereNearAnOpenSurface) {
  TriangleMesh open = tube();
  open.triangles.pop_back();
  const double around = winding_number(open, {9, 0, 20});
  EXPECT_GT(std::abs(around - std::round(around)), 1e-6);
}

TEST(WindingNumber, CountsTwiceWhereTwoSolidsOverlap) {
  TriangleMesh both = tube();
  append(both, tube());
  EXPECT_NEAR(winding_number(both, {0, -9, 1}), 2, 1e-12);
}

TEST(WindingNumber, StaysWhenAllIsMoved) {
  RandomStream random(5, 0);
  const RigidMotion elsewhere{exp_rotation({0.3, -1, 2}), {1000, -500, 2000}};
  const TriangleMesh there = moved(tube(), elsewhere);
  for (int i = 0; i < 50; ++i) {
    const Vec3 point(random.uniform(-12, 12), random.uniform(-12, 12), random.uniform(-5, 45));
    EXPECT_NEAR(winding_number(there, elsewhere * point), winding_number(tube(), point), 1e-9);
  }
}

TEST(DistanceTo, IsToTheFaceTheEdgeOrTheCorner) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_DOUBLE_EQ(distance_to(mesh, {2, 3, -7}), 7);
  EXPECT_DOUBLE_EQ(distance_to(mesh, {5, -3, 4}), 5);
  EXPECT_DOUBLE_EQ(distance_to(mesh, {13, -4, 0}), 5);
  EXPECT_DOUBLE_EQ(distance_to(mesh, {10, 10, 0}), std::sqrt(50));
  EXPECT_DOUBLE_EQ(distance_to(mesh, {3, 3, 0}), 0);
}

TEST(DistanceTo, TakesATriangleThatIsALine) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {4, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_DOUBLE_EQ(distance_to(mesh, {5, 2, 0}), 2);
  EXPECT_THROW(static_cast<void>(distance_to({}, {0, 0, 0})), ContractViolation);
}

}  // namespace
}  // namespace asterism
