// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/viewpoints.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

TriangleMesh tube() { return surface_of_revolution({{250, 0}, {300, 0}, {300, 400}, {250, 400}}, 90); }

TEST(ViewsOfSurface, StandOffFromTheSurfaceAndTiltNoMoreThanAsked) {
  const auto samples = sample_surface(tube(), 400, {}, 1);
  const auto views = views_of_surface(samples, 300, 300, rad_from_deg(35), 5);
  ASSERT_EQ(views.size(), 300U);
  for (const Viewpoint& view : views) {
    const Vec3 ahead = view.workpiece_from_scanner.rotation * Vec3::UnitZ();
    const Vec3 at = view.workpiece_from_scanner.translation + 300 * ahead;
    const auto aimed = std::min_element(samples.begin(), samples.end(), [&](const auto& a, const auto& b) {
      return (a.at - at).norm() < (b.at - at).norm();
    });
    EXPECT_NEAR((aimed->at - at).norm(), 0, 1e-9);
    EXPECT_GE(-ahead.dot(aimed->normal), std::cos(rad_from_deg(35)) - 1e-12);
  }
}

TEST(ViewsOfSurface, PassOverWhatNeedNotBeScanned) {
  const std::vector<ScanRegion> regions = {{"outside", Box{{1000, 1000, 1000}}, {}, 0}};
  EXPECT_TRUE(views_of_surface(sample_surface(tube(), 100, regions, 1), 10, 300, 0.6, 1).empty());
}

TEST(ViewsOfSphere, StandBeforeThePart) {
  const TriangleMesh ball = surface_of_revolution({{0, -100}, {100, 0}, {0, 100}}, 60);
  const auto views = views_of_sphere(RayScene(ball), facts_of(ball), 50, 300);
  EXPECT_EQ(views.size(), 50U);
  for (const Viewpoint& view : views) {
    const double r = view.workpiece_from_scanner.translation.norm();
    EXPECT_GE(r, 300 + 70);  // the double cone's faces are 70.7 mm from its middle,
    EXPECT_LE(r, 300 + 100 + 1e-6);
  }
}

TEST(ViewsOfCylinder, LookInAndOut) {
  const auto views = views_of_cylinder(RayScene(tube()), facts_of(tube()), 40, 120);
  EXPECT_EQ(views.size(), 40U);
  int inside = 0;
  for (const Viewpoint& view : views) {
    const Vec3& at = view.workpiece_from_scanner.translation;
    inside += std::hypot(at.x(), at.y()) < 250 ? 1 : 0;
  }
  EXPECT_EQ(inside, 20);
}

TEST(PaperRings, HaveTheStationsOfTables15And16) {
  const auto table15 = views_of_rings(paper_rings_96());
  const auto table16 = views_of_rings(paper_rings_72());
  ASSERT_EQ(table15.size(), 96U);
  ASSERT_EQ(table16.size(), 72U);
  // The second ring of Table 15 begins at (775.16, 0, 200); its row at 63 degrees is its eighth.
  const Vec3 second = table15[32].workpiece_from_scanner.translation;
  EXPECT_NEAR((second - Vec3(775.16, 0, 200)).norm(), 0, 0.01);
  const Vec3 eighth = table15[39].workpiece_from_scanner.translation;
  EXPECT_NEAR(deg_from_rad(std::atan2(eighth.y(), eighth.x())), 63, 1e-9);
  // On the part they look square at the cone r = 453.2 + 0.1208 z, 300 mm away.
  for (const Viewpoint& view : table16) {
    const Vec3 at = view.workpiece_from_scanner * Vec3(0, 0, 300);
    EXPECT_NEAR(std::hypot(at.x(), at.y()) - 0.1208 * at.z(), 453.2, 5);
  }
}

TEST(PaperRings, TiltedAreThoseOfTable16AsPrinted) {
  RingPattern pattern = paper_rings_72();
  pattern.tilt_deg = 10;
  const auto views = views_of_rings(pattern);
  // The second ring's centre is (52.094, 0, 295.442).
  Vec3 centre = Vec3::Zero();
  for (std::size_t i = 36; i < 72; ++i) centre += views[i].workpiece_from_scanner.translation / 36;
  EXPECT_NEAR((centre - Vec3(52.094, 0, 295.442)).norm(), 0, 0.001);
}

TEST(RingsAround, FindTheConeOfThePart) {
  const TriangleMesh cone =
      surface_of_revolution({{441.2, 0}, {453.2, 0}, {525.68, 600}, {513.68, 600}}, 180);
  const RingPattern pattern = rings_around(sample_surface(cone, 2000, {}, 1), 300, 200, 10);
  EXPECT_EQ(pattern.heights_mm.size(), 3U);
  EXPECT_NEAR(pattern.slope, 0.1208, 0.002);
  EXPECT_NEAR(pattern.radius_mm, 453.2 + 300 * std::hypot(1.0, 0.1208), 2);
}

}  // namespace
}  // namespace asterism
