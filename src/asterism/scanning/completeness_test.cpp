// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/completeness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {
namespace {

/// A square of the plane through `centre`, `edge` long, at random places that share its area.
void add_square(std::vector<SurfaceSample>& samples, const Vec3& centre, const Vec3& u, const Vec3& v,
                double edge, std::uint32_t count, std::uint64_t seed) {
  RandomStream random(seed, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    SurfaceSample sample;
    sample.at = centre + edge * ((random.uniform() - 0.5) * u + (random.uniform() - 0.5) * v);
    sample.normal = u.cross(v);
    sample.area_mm2 = edge * edge / count;
    samples.push_back(sample);
  }
}

std::vector<SurfaceSample> cube(double edge, std::uint32_t count) {
  std::vector<SurfaceSample> samples;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 normal = sign * Vec3::Unit(axis), u = Vec3::Unit((axis + 1) % 3);
      add_square(samples, 0.5 * edge * normal, u, normal.cross(u), edge, count,
                 static_cast<std::uint64_t>(3 * axis + (sign > 0 ? 1 : 0)));
    }
  }
  return samples;
}

/// Points every `pitch` on a face of a cube, `off` from it; no nearer to its rim than that.
void scan_face(Cloud& cloud, double edge, const Vec3& normal, double pitch, double off, bool with_normals) {
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  for (double a = -0.5 * edge + pitch; a < 0.5 * edge; a += pitch) {
    for (double b = -0.5 * edge + pitch; b < 0.5 * edge; b += pitch) {
      cloud.points.push_back((0.5 * edge + off) * normal + a * u + b * v);
      if (with_normals) cloud.normals.push_back(normal.cast<float>());
    }
  }
}

TEST(Completeness, IsTheShareOfACubeWhoseFacesWereScanned) {
  const auto samples = cube(100, 500);
  for (const bool with_normals : {true, false}) {
    Cloud cloud;
    for (const Vec3& normal : {Vec3(Vec3::UnitX()), Vec3(-Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
      scan_face(cloud, 100, normal, 2, 0.05, with_normals);
    }
    const Completeness found = completeness_of(cloud, samples, {});
    EXPECT_NEAR(found.surface_mm2, 60000, 1e-6);
    // Exactly: a point counts for the face it was measured on, even at the cube's edges.
    EXPECT_NEAR(found.share(), 0.5, 1e-12);
    ASSERT_EQ(found.holes.size(), 3U);  // three faces, each facing its own way
    for (const Hole& hole : found.holes) {
      EXPECT_NEAR(hole.area_mm2, 10000, 1e-6);
      EXPECT_NEAR(hole.normal.cwiseAbs().maxCoeff(), 1, 1e-12);
      // 500 places at random: 29 mm / √500 = 1.3 mm along each axis.
      EXPECT_LT((hole.centre - 50 * hole.normal).norm(), 5);
      EXPECT_NEAR(hole.across_mm, 141, 15);  // the diagonal, or nearly
    }
  }
}

TEST(Completeness, FindsARoundPatchThatIsMissing) {
  std::vector<SurfaceSample> samples;
  add_square(samples, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 300, 9000, 1);
  const Vec3 middle(30, -20, 0);
  Cloud cloud;
  for (double x = -150; x <= 150; x += 1) {
    for (double y = -150; y <= 150; y += 1) {
      if ((Vec3(x, y, 0) - middle).norm() > 60) cloud.points.emplace_back(x, y, 0.02);
    }
  }
  const Completeness found = completeness_of(cloud, samples, {});
  ASSERT_FALSE(found.holes.empty());
  const Hole& hole = found.holes.front();
  // A place counts as measured when three points lie within 5 mm: to about 4.5 mm into the patch. The
  // number of places in it is binomial: 970 ± 29 of 9000.
  const double expected = std::numbers::pi * 55.5 * 55.5;
  EXPECT_NEAR(hole.area_mm2, expected, 3 * 29 * 10.0);
  EXPECT_NEAR(hole.across_mm, 2 * 55.5, 6);
  EXPECT_LT((hole.centre - middle).norm(), 3 * 55.5 / 2 / std::sqrt(970.0) * std::sqrt(2.0));
  EXPECT_LT((hole.normal - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(found.holes.size(), 1U);
  EXPECT_NEAR(found.measured_mm2 + hole.area_mm2, found.surface_mm2, 1e-6);
}

TEST(Completeness, KeepsTheSidesOfAThinWallApart) {
  for (const bool with_normals : {true, false}) {
    std::vector<SurfaceSample> wall;
    add_square(wall, {0, 0, 0.3}, Vec3::UnitX(), Vec3::UnitY(), 100, 800, 2);
    add_square(wall, {0, 0, -0.3}, Vec3::UnitY(), Vec3::UnitX(), 100, 800, 3);
    Cloud cloud;  // of the upper side, thinner than `off_mm`
    for (double x = -49; x < 50; x += 2) {
      for (double y = -49; y < 50; y += 2) {
        cloud.points.emplace_back(x, y, 0.35);
        if (with_normals) cloud.normals.emplace_back(0, 0, 1);
      }
    }
    const Completeness one = completeness_of(cloud, wall, {});
    EXPECT_NEAR(one.share(), 0.5, 1e-12);
    ASSERT_EQ(one.holes.size(), 1U);
    EXPECT_LT(one.holes[0].normal.z(), -0.999);
    const Completeness none = completeness_of({}, wall, {});
    EXPECT_EQ(none.share(), 0);
    ASSERT_EQ(none.holes.size(), 2U);  // back to back, yet not one
    EXPECT_NEAR(none.holes[0].area_mm2, 10000, 1e-6);
    EXPECT_NEAR(none.holes[1].area_mm2, 10000, 1e-6);
  }
}

TEST(Completeness, AsksForEnoughPointsNearTheSurfaceThatFaceItsWay) {
  SurfaceSample place;
  place.at = {10, 20, 30};
  place.normal = Vec3::UnitZ();
  place.area_mm2 = 1;
  const std::vector<SurfaceSample> samples = {place};
  const auto near = [&](const Vec3& off, const Vec3f& normal, int copies) {
    Cloud cloud;
    cloud.points.assign(static_cast<std::size_t>(copies), place.at + off);
    cloud.normals.assign(static_cast<std::size_t>(copies), normal);
    return completeness_of(cloud, samples, {}).points[0];
  };
  const Vec3f up(0, 0, 1), unknown(0, 0, 0);
  EXPECT_EQ(near({3, 3.9, 0.5}, up, 3), 3);
  EXPECT_EQ(near({3, 4.1, 0}, up, 3), 0);   // 5.08 mm away
  EXPECT_EQ(near({0, 0, 1.01}, up, 3), 0);  // off the surface
  EXPECT_EQ(near({0, 0, -1.01}, up, 3), 0);
  EXPECT_EQ(near({0, 0, 0.5}, -up, 3), 0);  // of another side
  EXPECT_EQ(near({0, 0, 0.5}, unknown, 3), 3);
  EXPECT_EQ(near({0, 0, 0.5}, Vec3f(0.8F, 0, 0.6F), 3), 3);
  EXPECT_EQ(near({0, 0, 0.5}, Vec3f(0.9F, 0, 0.43F), 3), 0);  // 64°
  EXPECT_EQ(near({NAN, 0, 0}, up, 3), 0);
  EXPECT_EQ(near({1e12, 0, 0}, up, 3), 0);
  Cloud two;
  two.points.assign(2, place.at);
  EXPECT_EQ(completeness_of(two, samples, {}).share(), 0);
  two.points.push_back(place.at);
  EXPECT_EQ(completeness_of(two, samples, {}).share(), 1);
}

TEST(Completeness, LeavesOutWhatNeedNotBeMeasured) {
  auto samples = cube(100, 200);
  for (SurfaceSample& sample : samples) sample.weight = sample.normal.z() < -0.5 ? 0 : 2;
  Cloud cloud;
  scan_face(cloud, 100, Vec3::UnitX(), 2, 0, false);
  const Completeness found = completeness_of(cloud, samples, {});
  EXPECT_NEAR(found.surface_mm2, 50000, 1e-6);
  EXPECT_NEAR(found.share(), 0.2, 1e-12);
  for (const Hole& hole : found.holes) EXPECT_GT(hole.normal.z(), -0.5);
}

TEST(Completeness, HasNoDirectionForAHoleThatGoesAllAround) {
  std::vector<SurfaceSample> belt;
  RandomStream random(4, 0);
  for (int i = 0; i < 3000; ++i) {
    const double turn = 2 * std::numbers::pi * random.uniform();
    SurfaceSample sample;
    sample.normal = {std::cos(turn), std::sin(turn), 0};
    sample.at = 200 * sample.normal + 100 * random.uniform() * Vec3::UnitZ();
    sample.area_mm2 = 2 * std::numbers::pi * 200 * 100 / 3000;
    belt.push_back(sample);
  }
  const Completeness found = completeness_of({}, belt, {});
  ASSERT_EQ(found.holes.size(), 1U);
  EXPECT_EQ(found.holes[0].normal, Vec3::Zero());
  EXPECT_NEAR(found.holes[0].across_mm, std::hypot(400, 100), 12);
}

TEST(Completeness, IsTheSameInPiecesMovedAndOnAnyNumberOfThreads) {
  const auto samples = cube(100, 1000);
  Cloud cloud;
  RandomStream random(5, 0);
  for (int i = 0; i < 40000; ++i) {
    cloud.points.emplace_back(120 * (random.uniform() - 0.5), 120 * (random.uniform() - 0.5),
                              50 + 0.3 * random.normal());
  }
  set_thread_count(1);
  const Completeness whole = completeness_of(cloud, samples, {});
  set_thread_count(3);
  CompletenessCount count(samples, {});
  for (std::size_t first = 0; first < cloud.size(); first += 7001) {
    Cloud piece;
    const std::size_t end = std::min(cloud.size(), first + 7001);
    for (std::size_t i = first; i < end; ++i) piece.points.push_back(cloud.points[i]);
    count.add(piece);
  }
  const Completeness pieces = count.finish();
  set_thread_count(0);
  EXPECT_GT(whole.share(), 0.1);
  EXPECT_EQ(pieces.points, whole.points);
  EXPECT_EQ(pieces.measured, whole.measured);
  EXPECT_EQ(pieces.holes.size(), whole.holes.size());

  const RigidMotion elsewhere{exp_rotation({0.3, -1, 2}), {1500, -700, 2100}};
  auto there = samples;
  for (SurfaceSample& sample : there) {
    sample.at = elsewhere * sample.at;
    sample.normal = elsewhere.rotation * sample.normal;
  }
  for (Vec3& point : cloud.points) point = elsewhere * point;
  const Completeness moved = completeness_of(cloud, there, {});
  EXPECT_EQ(moved.measured, whole.measured);
  ASSERT_EQ(moved.holes.size(), whole.holes.size());
  EXPECT_LT((moved.holes[0].centre - elsewhere * whole.holes[0].centre).norm(), 1e-9);
}

TEST(Completeness, OfNothingIsNothing) {
  EXPECT_EQ(completeness_of({}, {}, {}).share(), 0);
  Cloud cloud;
  cloud.points.emplace_back(0, 0, 0);
  EXPECT_EQ(completeness_of(cloud, {}, {}).share(), 0);
  EXPECT_TRUE(completeness_of(cloud, {}, {}).holes.empty());
}

}  // namespace
}  // namespace asterism
