// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/display_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// A wall 12 mm thick, finely divided: 100 rings of 400.
TriangleMesh wall() {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= 100; ++i) profile.push_back({500, 5.0 * i});
  for (int i = 100; i >= 0; --i) profile.push_back({488, 5.0 * i});
  return surface_of_revolution(profile, 400);
}

TEST(Thinned, LeavesASmallSurfaceAsItIs) {
  const TriangleMesh surface = surface_of_revolution({{0, 0}, {10, 0}, {0, 10}}, 8);
  const DisplayMesh shown = thinned(surface, {}, 1000);
  EXPECT_EQ(shown.surface.triangles, surface.triangles);
  EXPECT_EQ(shown.cell_mm, 0);
  EXPECT_TRUE(shown.value.empty());
}

TEST(Thinned, KeepsShapeWithFewTriangles) {
  const TriangleMesh surface = wall();
  const DisplayMesh shown = thinned(surface, {}, 10000);
  EXPECT_LE(shown.surface.triangles.size(), 10000U);
  EXPECT_GT(shown.surface.triangles.size(), 3000U);
  // A mean over a cell cuts the circle's sagitta, well below a per cent here.
  EXPECT_NEAR(facts_of(shown.surface).area_mm2 / facts_of(surface).area_mm2, 1, 0.03);
}

TEST(Thinned, KeepsBothFacesOfAThinWallApart) {
  const DisplayMesh shown = thinned(wall(), {}, 10000);
  ASSERT_GT(shown.cell_mm, 12);  // else the wall would not be put to the test
  int between = 0;
  for (const Vec3& vertex : shown.surface.vertices) {
    const double radius = vertex.head<2>().norm();
    if (vertex.z() > 30 && vertex.z() < 470 && radius > 491 && radius < 497) ++between;
  }
  EXPECT_EQ(between, 0);
}

TEST(Thinned, KeepsTheLargestValueAndLeavesOutWhatIsNone) {
  const TriangleMesh surface = wall();
  std::vector<double> value(surface.vertices.size(), 0.01);
  value[1234] = 0.2;
  value[1235] = std::numeric_limits<double>::quiet_NaN();
  const DisplayMesh shown = thinned(surface, value, 10000);
  ASSERT_EQ(shown.value.size(), shown.surface.vertices.size());
  EXPECT_EQ(*std::max_element(shown.value.begin(), shown.value.end()), 0.2);
  EXPECT_TRUE(std::none_of(shown.value.begin(), shown.value.end(), [](double mm) { return std::isnan(mm); }));
}

TEST(Thinned, RefusesValuesThatAreNotOneAVertex) {
  EXPECT_THROW(static_cast<void>(thinned(wall(), {1, 2}, 10)), ContractViolation);
}

}  // namespace
}  // namespace asterism
