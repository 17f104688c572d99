// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/surface_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/mesh_queries.hpp"
#include "asterism/geometry/rays_for_tests.hpp"

namespace asterism {
namespace {

/// Twelve digits of lengths of some 100 mm.
constexpr double kDigits_mm = 1e-10;

/// From −half to half, two triangles a side.
TriangleMesh box(const Vec3& half) {
  TriangleMesh mesh;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) mesh.vertices.emplace_back(Vec3(x, y, z).cwiseProduct(half));
    }
  }
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return mesh;
}

double distance_to_box(const Vec3& point, const Vec3& half) {
  const Vec3 beyond = point.cwiseAbs() - half;
  return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

/// A prism along x whose edge at the origin points up (+z), its sides at half the angle to either hand.
TriangleMesh wedge(double half_angle_rad) {
  const double wide = 100 * std::tan(half_angle_rad);
  TriangleMesh mesh;
  for (const double x : {-50.0, 50.0}) {
    mesh.vertices.emplace_back(x, 0, 0);
    mesh.vertices.emplace_back(x, -wide, -100);
    mesh.vertices.emplace_back(x, wide, -100);
  }
  mesh.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {0, 3, 5}, {0, 5, 2}, {1, 2, 5}, {1, 5, 4}};
  return mesh;
}

/// Corners of different triangles are different vertices, as STL has them.
TriangleMesh unwelded(const TriangleMesh& mesh) {
  TriangleMesh apart;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(apart.vertices.size());
    for (int k = 0; k < 3; ++k) apart.vertices.push_back(mesh.corner(t, k));
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  return apart;
}

double signed_distance(const SurfaceTree& tree, const Vec3& point) {
  const auto found = tree.nearest(point);
  EXPECT_TRUE(found.has_value());
  return found ? found->signed_distance_mm : NAN;
}

TEST(SurfaceTree, KnowsTheDistanceToABoxOnBothSidesOfFacesEdgesAndCorners) {
  const Vec3 half(40, 25, 10);
  ASSERT_TRUE(facts_of(box(half)).closed());
  for (const TriangleMesh& mesh : {box(half), unwelded(box(half))}) {
    const SurfaceTree tree(mesh);
    RandomStream random(1, 0);
    for (int i = 0; i < 5000; ++i) {
      const Vec3 point = rays::in_box(random, 1).cwiseProduct(1.6 * half);
      EXPECT_NEAR(signed_distance(tree, point), distance_to_box(point, half), kDigits_mm);
    }
    // Just off each corner and the middle of each edge, in and out.
    for (const double x : {-1.0, 0.0, 1.0}) {
      for (const double y : {-1.0, 0.0, 1.0}) {
        for (const double z : {-1.0, 0.0, 1.0}) {
          for (const double share : {0.999, 1.001}) {
            const Vec3 point = share * Vec3(x, y, z).cwiseProduct(half);
            EXPECT_NEAR(signed_distance(tree, point), distance_to_box(point, half), kDigits_mm);
          }
        }
      }
    }
  }
}

TEST(SurfaceTree, TellsWhereTheNearestPointIsAndHowTheSurfaceFacesThere) {
  const SurfaceTree tree(box({40, 25, 10}));
  const auto face = tree.nearest({3, 4, 12});
  ASSERT_TRUE(face.has_value());
  EXPECT_LT((face->at - Vec3(3, 4, 10)).norm(), kDigits_mm);
  EXPECT_LT((face->normal - Vec3::UnitZ()).norm(), kDigits_mm);
  EXPECT_TRUE(face->triangle == 10 || face->triangle == 11);
  const auto edge = tree.nearest({41, 3, 11});
  ASSERT_TRUE(edge.has_value());
  EXPECT_LT((edge->at - Vec3(40, 3, 10)).norm(), kDigits_mm);
  EXPECT_LT((edge->normal - Vec3(1, 0, 1).normalized()).norm(), kDigits_mm);
  // By angle, not by how many triangles happen to meet there.
  const auto corner = tree.nearest({41, 26, 11});
  ASSERT_TRUE(corner.has_value());
  EXPECT_LT((corner->at - Vec3(40, 25, 10)).norm(), kDigits_mm);
  EXPECT_LT((corner->normal - Vec3(1, 1, 1).normalized()).norm(), kDigits_mm);
}

TEST(SurfaceTree, KnowsTheDistanceToATurnedCylinder) {
  const double radius = 100;
  const int sides = 720;
  const SurfaceTree tree(surface_of_revolution({{0, -80}, {radius, -80}, {radius, 80}, {0, 80}}, sides));
  // The polygon lies within the circle by R (1 − cos(π/n)) = 0.95 µm.
  const double sagitta_mm = radius * (1 - std::cos(std::numbers::pi / sides));
  RandomStream random(2, 0);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 point = rays::in_box(random, 150);
    const Vec2 beyond(std::hypot(point.x(), point.y()) - radius, std::abs(point.z()) - 80);
    const double expected = beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
    const double measured = signed_distance(tree, point);
    EXPECT_GE(measured, expected - kDigits_mm);
    EXPECT_LE(measured, expected + sagitta_mm + kDigits_mm);
  }
}

TEST(SurfaceTree, KnowsTheDistanceToASphere) {
  const double radius = 50;
  std::vector<ProfilePoint> arc;
  const int steps = 400;
  for (int i = 0; i <= steps; ++i) {
    const double down = -std::numbers::pi / 2 + std::numbers::pi * i / steps;
    arc.push_back({i == 0 || i == steps ? 0 : radius * std::cos(down), radius * std::sin(down)});
  }
  const SurfaceTree tree(surface_of_revolution(arc, 2 * steps));
  // Two steps of π/400 meet: within the sphere by at most 2 R (1 − cos(π/800)) = 0.8 µm.
  const double sagitta_mm = 2 * radius * (1 - std::cos(std::numbers::pi / (2 * steps)));
  RandomStream random(3, 0);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 point = rays::in_box(random, 70);
    const double off = signed_distance(tree, point) - (point.norm() - radius);
    EXPECT_GE(off, -kDigits_mm);
    EXPECT_LE(off, sagitta_mm + kDigits_mm);
  }
}

TEST(SurfaceTree, TakesTheSideOfAThinWallOnWhichThePointLies) {
  const Vec3 half(200, 200, 0.05);
  const SurfaceTree tree(box(half));
  EXPECT_NEAR(signed_distance(tree, {30, -70, 0.06}), 0.01, kDigits_mm);
  EXPECT_NEAR(signed_distance(tree, {30, -70, -0.06}), 0.01, kDigits_mm);
  EXPECT_NEAR(signed_distance(tree, {30, -70, 0.04}), -0.01, kDigits_mm);
  EXPECT_GT(tree.nearest({30, -70, 0.06})->normal.z(), 0.999);
  EXPECT_LT(tree.nearest({30, -70, -0.06})->normal.z(), -0.999);
  // Beyond its rim, above and below.
  EXPECT_NEAR(signed_distance(tree, {200.3, 0, 0.45}), 0.5, kDigits_mm);
  EXPECT_NEAR(signed_distance(tree, {200.3, 0, -0.45}), 0.5, kDigits_mm);
}

TEST(SurfaceTree, IsOutsideBeyondAnEdgeSoAcuteThatOneOfItsTrianglesFacesAway) {
  // Sides of 10°: a point beyond the edge lies behind the plane of one side and before that of the other.
  const double half_angle = rad_from_deg(5);
  const TriangleMesh mesh = wedge(half_angle);
  ASSERT_TRUE(facts_of(mesh).closed());
  const SurfaceTree tree(mesh);
  int behind_one = 0;
  for (double turn = -80; turn <= 80; turn += 1) {
    const double up = rad_from_deg(turn);
    for (const double x : {-49.0, -7.0, 13.0}) {
      const Vec3 point(x, 5 * std::sin(up), 5 * std::cos(up));
      const auto found = tree.nearest(point);
      ASSERT_TRUE(found.has_value());
      EXPECT_NEAR(found->signed_distance_mm, 5, kDigits_mm);
      behind_one += area_vector(mesh, 2).dot(point) < 0 || area_vector(mesh, 4).dot(point) < 0 ? 1 : 0;
    }
  }
  EXPECT_GT(behind_one, 300);  // so that a triangle's own normal would have failed here
  EXPECT_LT(signed_distance(tree, {0, 0, -5}), 0);
  // At the tip of the edge a corner is the nearest, and there too.
  for (double turn = -80; turn <= 80; turn += 5) {
    const double up = rad_from_deg(turn);
    EXPECT_GT(signed_distance(tree, {53, 3 * std::sin(up), 3 * std::cos(up)}), 0);
  }
}

TEST(SurfaceTree, HasTheSignOfTheWindingNumberAndTheDistanceOfBruteForce) {
  // A thin tube with a flange and a sharp lip.
  const TriangleMesh mesh =
      surface_of_revolution({{90, 0}, {100, -20}, {120, 0}, {92, 4}, {91, 80}, {99, 90}, {88, 80}}, 24);
  ASSERT_TRUE(facts_of(mesh).closed());
  const SurfaceTree tree(mesh);
  RandomStream random(4, 0);
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 point = Vec3(0, 0, 40) + rays::in_box(random, 1).cwiseProduct(Vec3(130, 130, 70));
    const bool is_inside = winding_number(mesh, point) > 0.5;
    const double distance = distance_to(mesh, point);
    EXPECT_NEAR(signed_distance(tree, point), is_inside ? -distance : distance, kDigits_mm);
    inside += is_inside ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
}

TEST(SurfaceTree, FindsInASoupOfTrianglesWhatBruteForceFinds) {
  RandomStream random(5, 0);
  const TriangleMesh mesh = rays::soup(300, random);
  const SurfaceTree tree(mesh);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 point = rays::in_box(random, 700);
    const auto found = tree.nearest(point);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(std::abs(found->signed_distance_mm), distance_to(mesh, point), kDigits_mm);
    EXPECT_NEAR((found->at - point).norm(), std::abs(found->signed_distance_mm), kDigits_mm);
  }
}

TEST(SurfaceTree, IsAsRightFarFromTheOrigin) {
  const Vec3 half(40, 25, 10);
  const RigidMotion elsewhere{exp_rotation({0.3, -1, 2}), {25000, -18000, 30000}};
  const SurfaceTree tree(moved(box(half), elsewhere));
  RandomStream random(6, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 point = rays::in_box(random, 1).cwiseProduct(1.6 * half);
    // 30 m have 4 fewer digits than 3 mm; in single precision this would be 2 µm.
    EXPECT_NEAR(signed_distance(tree, elsewhere * point), distance_to_box(point, half), 1e-10);
  }
}

TEST(SurfaceTree, FindsNothingFartherThanAsked) {
  const SurfaceTree tree(box({10, 10, 10}));
  EXPECT_FALSE(tree.nearest({0, 0, 15.001}, 5).has_value());
  EXPECT_TRUE(tree.nearest({0, 0, 14.999}, 5).has_value());
  EXPECT_FALSE(tree.nearest({0, 0, 3}, 5).has_value());  // within the part, too
  EXPECT_TRUE(tree.nearest({0, 0, 10}, 0).has_value());
  const std::vector<Vec3> points = {{0, 0, 15.001}, {0, 0, 14}, {NAN, 0, 0}};
  const std::vector<double> distances = tree.signed_distances(points, 5);
  EXPECT_TRUE(std::isnan(distances[0]));
  EXPECT_NEAR(distances[1], 4, kDigits_mm);
  EXPECT_TRUE(std::isnan(distances[2]));
  EXPECT_THROW((void)tree.nearest({0, 0, 0}, -1), ContractViolation);
}

TEST(SurfaceTree, OfNothingHasNoNearestPoint) {
  TriangleMesh line;  // a triangle without area is no surface
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.triangles = {{0, 1, 2}, {1, 1, 2}};
  for (const TriangleMesh& mesh : {TriangleMesh{}, line}) {
    const SurfaceTree tree(mesh);
    EXPECT_FALSE(tree.nearest({0, 0, 1}).has_value());
    EXPECT_TRUE(std::isnan(tree.signed_distances(std::vector<Vec3>(1, Vec3::Zero()))[0]));
  }
}

TEST(SurfaceTree, TakesTheSignOfTheNearestFeatureWhereTheSurfaceIsOpen) {
  TriangleMesh plate;
  plate.vertices = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}};
  plate.triangles = {{0, 1, 2}, {0, 2, 3}};
  const SurfaceTree tree(plate);
  EXPECT_NEAR(signed_distance(tree, {10, 20, 3}), 3, kDigits_mm);
  EXPECT_NEAR(signed_distance(tree, {10, 20, -3}), -3, kDigits_mm);
  EXPECT_NEAR(signed_distance(tree, {53, 0, -4}), -5, kDigits_mm);
  EXPECT_NEAR(signed_distance(SurfaceTree(flipped(plate)), {10, 20, 3}), -3, kDigits_mm);
  // A sheet of two faces back to back: its sum of normals at an edge is none, its own normal counts.
  TriangleMesh sheet = plate;
  append(sheet, flipped(plate));
  EXPECT_NEAR(std::abs(signed_distance(SurfaceTree(sheet), {53, 0, -4})), 5, kDigits_mm);
}

TEST(SurfaceTree, IsNotMisledByTrianglesThatAreLines) {
  TriangleMesh mesh = box({40, 25, 10});
  // On the edge from (40, 25, −10) to (40, 25, 10), as single precision leaves it: a needle that faces down.
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{40, 25, -10}, {40 - 1e-7, 25, 0}, {40, 25, 10}});
  mesh.triangles.push_back({first, first + 2, first + 1});
  const SurfaceTree tree(mesh);
  for (const double z : {-9.0, 0.0, 9.0, 10.5}) EXPECT_GT(signed_distance(tree, {40.001, 25.1, z}), 0);
  EXPECT_LT(signed_distance(tree, {39.9, 24.9, 0}), 0);
}

TEST(SurfaceTree, AnswersManyPointsAsEachByItselfOnAnyNumberOfThreads) {
  const TriangleMesh mesh = surface_of_revolution({{90, 0}, {100, -20}, {120, 0}, {92, 4}, {91, 80}}, 48);
  const SurfaceTree tree(mesh);
  RandomStream random(7, 0);
  std::vector<Vec3> points;
  for (int i = 0; i < 9000; ++i) points.push_back(rays::in_box(random, 130));
  set_thread_count(1);
  const std::vector<double> alone = tree.signed_distances(points);
  set_thread_count(3);
  const std::vector<double> together = tree.signed_distances(points);
  set_thread_count(0);
  EXPECT_EQ(together, alone);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(alone[i], tree.nearest(points[i])->signed_distance_mm);
  }
}

}  // namespace
}  // namespace asterism
