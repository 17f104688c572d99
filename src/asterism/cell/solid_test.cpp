// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asterism/geometry/mesh_queries.hpp"

namespace asterism {
namespace {

/// Distance from z of a point of the surface on the ray at a height, from outside.
double radius_at(const TriangleMesh& mesh, double height_mm) {
  double radius = 0;
  for (const Vec3& vertex : mesh.vertices) {
    if (std::abs(vertex.z() - height_mm) < 1e-9) radius = std::max(radius, vertex.head<2>().norm());
  }
  return radius;
}

TEST(Casing, IsClosedAndFacesOutwards) {
  const MeshFacts facts = facts_of(mesh_of(CasingShape{}));
  EXPECT_TRUE(facts.closed());
  EXPECT_EQ(facts.degenerate, 0U);
  EXPECT_GT(facts.volume_mm3, 0);
  EXPECT_NEAR(facts.lowest.z(), 0, 1e-12);
  EXPECT_NEAR(facts.highest.z(), 560, 1e-12);
}

TEST(Casing, HasTheRadiiItIsTold) {
  CasingShape plain;
  plain.flange_width_mm = 0;
  plain.bosses = 0;
  EXPECT_NEAR(radius_at(mesh_of(plain), 0), 453.2, 1e-9);
  EXPECT_NEAR(radius_at(mesh_of(plain), 560), 520.8, 1e-9);
  EXPECT_NEAR(radius_at(mesh_of(CasingShape{}), 560), 560.8, 1e-9);
  // The paper's cone: r = 453.2 + 0.1208 z, 12 mm thick, open inside; between two corners of the polygon it
  // is thinner by r (1 − cos 1°) = 0.07 mm.
  const TriangleMesh mesh = mesh_of(plain);
  const double outer = 453.2 + 0.1208 * 280;
  EXPECT_NEAR(winding_number(mesh, {outer - 1, 0, 280}), 1, 1e-9);
  EXPECT_NEAR(winding_number(mesh, {outer + 1, 0, 280}), 0, 1e-9);
  EXPECT_NEAR(winding_number(mesh, {outer - 11, 0, 280}), 1, 1e-9);
  EXPECT_NEAR(winding_number(mesh, {outer - 13, 0, 280}), 0, 1e-9);
}

TEST(Casing, HasTheVolumeOfItsCone) {
  CasingShape plain;
  plain.flange_width_mm = 0;
  plain.bosses = 0;
  const auto frustum = [](double a, double b, double h) {
    return std::numbers::pi * h / 3 * (a * a + a * b + b * b);
  };
  const double volume = frustum(453.2, 520.8, 560) - frustum(441.2, 508.8, 560);
  // A polygon of 180 sides holds sin(2°)/(2° in rad) = 0.9998 of its circle.
  EXPECT_NEAR(facts_of(mesh_of(plain)).volume_mm3 / volume, 1, 3e-4);
}

TEST(Casing, HasBossesAllAround) {
  CasingShape casing;
  casing.flange_width_mm = 0;
  const TriangleMesh mesh = mesh_of(casing);
  const double wall = 0.5 * (453.2 + 520.8);
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * std::numbers::pi * i / 12;
    const Vec3 outwards(std::cos(angle), std::sin(angle), 0);
    EXPECT_NEAR(winding_number(mesh, (wall + 20) * outwards + Vec3(0, 0, 280)), 1, 1e-9) << i;
    EXPECT_NEAR(winding_number(mesh, (wall + 31) * outwards + Vec3(0, 0, 280)), 0, 1e-9) << i;
  }
  EXPECT_NEAR(winding_number(mesh, {(wall + 20) * std::cos(0.26), (wall + 20) * std::sin(0.26), 280}), 0,
              1e-9);
}

}  // namespace
}  // namespace asterism
