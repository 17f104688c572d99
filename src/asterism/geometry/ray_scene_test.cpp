// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/ray_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "asterism/core/parallel.hpp"
#include "asterism/geometry/rays_for_tests.hpp"

namespace asterism {
namespace {

/// Two triangles, 100 mm square, across z at a height; they face up.
TriangleMesh plate(double z) {
  return {{{-50, -50, z}, {50, -50, z}, {50, 50, z}, {-50, 50, z}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// A barrel with walls, as a casing has them.
TriangleMesh barrel(int sides = 90) {
  return surface_of_revolution({{500, 0}, {500, 20}, {450, 20}, {500, 500}, {480, 500}, {440, 0}}, sides);
}

TEST(RayScene, FindsTheFirstOfSeveralSurfaces) {
  const std::vector<TriangleMesh> surfaces = {plate(300), {}, plate(100), plate(200)};
  const RayScene scene(surfaces);
  EXPECT_EQ(scene.triangles(), 6U);
  const auto down = scene.first_hit({10, -20, 500}, {10, -20, -500});
  ASSERT_TRUE(down.has_value());
  EXPECT_EQ(down->surface, 0U);
  EXPECT_EQ(down->triangle, 0U);
  EXPECT_NEAR(down->share, 0.2, 1e-6);  // single precision
  EXPECT_LT((down->normal - Vec3::UnitZ()).norm(), 1e-6);
  const auto up = scene.first_hit({-20, 10, 0}, {-20, 10, 1000});
  ASSERT_TRUE(up.has_value());
  EXPECT_EQ(up->surface, 2U);  // counted as given, the empty one too
  EXPECT_EQ(up->triangle, 1U);
  EXPECT_NEAR(up->share, 0.1, 1e-6);
  EXPECT_LT((up->normal - Vec3::UnitZ()).norm(), 1e-6);  // by the triangle's sense, from either side
}

TEST(RayScene, LooksBetweenTheTwoPointsOnly) {
  const RayScene scene(plate(100));
  EXPECT_TRUE(scene.blocked({0, 1, 0}, {0, 1, 200}));
  EXPECT_TRUE(scene.blocked({0, 1, 200}, {0, 1, 0}));
  EXPECT_FALSE(scene.blocked({0, 1, 0}, {0, 1, 99}));
  EXPECT_FALSE(scene.blocked({0, 1, 200}, {0, 1, 101}));
  EXPECT_FALSE(scene.blocked({0, 1, 101}, {0, 1, 300}));
  EXPECT_FALSE(scene.blocked({60, 1, 0}, {60, 1, 200}));
  EXPECT_FALSE(scene.first_hit({0, 1, 0}, {0, 1, 99}).has_value());
}

TEST(RayScene, OfNothingBlocksNothing) {
  for (const auto& surfaces : {std::vector<TriangleMesh>{}, std::vector<TriangleMesh>(2)}) {
    const RayScene scene(surfaces);
    EXPECT_TRUE(scene.empty());
    EXPECT_FALSE(scene.blocked({0, 0, 0}, {0, 0, 1000}));
    EXPECT_FALSE(scene.first_hit({0, 0, 0}, {0, 0, 1000}).has_value());
  }
}

TEST(RayScene, LetsNoRayThroughAnEdgeOrACorner) {
  const RayScene scene(plate(100));
  for (double at = -49; at < 50; at += 0.37) EXPECT_TRUE(scene.blocked({at, at, 0}, {at, at, 200}));
  // Through the diagonal that both triangles share, from all sides.
  const RayScene closed(barrel(12));
  RandomStream random(4, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 rim =
        500 * Vec3(std::cos(std::numbers::pi / 6 * (i % 12)), std::sin(std::numbers::pi / 6 * (i % 12)), 0);
    const Vec3 edge = rim + (20.0 * random.uniform()) * Vec3::UnitZ();
    const Vec3 inwards(-edge.x(), -edge.y(), 0);
    EXPECT_TRUE(closed.blocked(edge - inwards, edge + 0.05 * inwards));
  }
}

TEST(RayScene, AnswersManyWaysAsEachByItself) {
  const TriangleMesh mesh = barrel();
  const RayScene scene(mesh);
  RandomStream random(1, 0);
  const Vec3 to(1800, 900, 1500);
  std::vector<Vec3> from;
  for (int i = 0; i < 3000; ++i) from.push_back(rays::from_surface(mesh, random).from);
  std::vector<std::uint8_t> together(from.size());
  scene.blocked(from, to, together);
  for (std::size_t i = 0; i < from.size(); ++i) {
    EXPECT_EQ(together[i] != 0, scene.blocked(from[i], to));
    EXPECT_EQ(together[i] != 0, scene.first_hit(from[i], to).has_value());
  }
}

TEST(RayScene, AnswersABundleAsEachWayByItself) {
  const TriangleMesh mesh = barrel();
  const RayScene scene(mesh);
  std::size_t part = 0;
  for (std::uint64_t bundle = 0; bundle < 2000; ++bundle) {
    RandomStream random(6, bundle);
    const rays::Way way = rays::from_surface(mesh, random);
    std::vector<Vec3> from;
    for (std::uint32_t i = 0; i <= bundle % 40; ++i) from.push_back(way.from + rays::in_box(random, 12));
    std::vector<std::uint8_t> alone(from.size()), together(from.size());
    scene.blocked(from, way.to, alone);
    const auto expected = static_cast<std::size_t>(std::count(alone.begin(), alone.end(), 1));
    EXPECT_EQ(scene.block_bundle(from, way.to, from.size(), together), expected);
    EXPECT_EQ(together, alone);
    part += expected > 0 && expected < from.size() ? 1 : 0;
  }
  EXPECT_GT(part, 100U);
}

TEST(RayScene, AsksOfABundleNoMoreThanItMust) {
  const RayScene scene(plate(100));
  const std::vector<Vec3> from(100, Vec3(0, 1, 0));
  std::vector<std::uint8_t> marks(100);
  marks[99] = 1;
  EXPECT_EQ(scene.block_bundle(from, {0, 1, 200}, 1, marks), 2U);  // the first and the one marked before
  EXPECT_EQ(std::count(marks.begin(), marks.end(), 1), 2);
  EXPECT_EQ(scene.block_bundle(from, {0, 1, 200}, 5, marks), 18U);   // and sixteen more
  EXPECT_EQ(scene.block_bundle(from, {0, 1, 50}, 100, marks), 18U);  // what is marked stays so
  EXPECT_EQ(scene.block_bundle({}, {0, 1, 50}, 0, {}), 0U);
}

TEST(RayScene, AnswersManyThreadsAlike) {
  const TriangleMesh mesh = barrel();
  const RayScene scene(mesh);
  std::vector<std::uint8_t> alone(4000), together(alone.size());
  const auto ask = [&](std::vector<std::uint8_t>& out, std::size_t i) {
    RandomStream random(2, i);
    const rays::Way way = rays::from_surface(mesh, random);
    out[i] = scene.blocked(way.from, way.to) ? 1 : 0;
  };
  for (std::size_t i = 0; i < alone.size(); ++i) ask(alone, i);
  set_thread_count(4);
  parallel_for(together.size(), [&](std::size_t i) { ask(together, i); });
  set_thread_count(0);
  EXPECT_EQ(together, alone);
}

TEST(RayScene, CanBeCopiedAndOutlivesTheSurface) {
  std::optional<RayScene> copy;
  {
    const TriangleMesh mesh = plate(100);
    const RayScene scene(mesh);
    copy = scene;
  }
  EXPECT_TRUE(copy->blocked({0, 1, 0}, {0, 1, 200}));
}

/// How many of `count` ways are answered otherwise than in double precision, and how many of those do not run
/// within 0.01 mm of an edge. Single precision errs by 0.0002 mm here.
struct Disagreement {
  int all = 0, away_from_edges = 0, blocked = 0;
};
template <class Draw>
Disagreement disagreement(const TriangleMesh& mesh, int count, const Draw& draw) {
  const RayScene scene(mesh);
  const auto exactly = [&](const Vec3& from, const Vec3& to) { return blocked_exactly(mesh, from, to); };
  std::atomic<int> all = 0, away = 0, blocked = 0;
  parallel_for(static_cast<std::size_t>(count), [&](std::size_t i) {
    RandomStream random(3, i);
    const rays::Way way = draw(random);
    const bool exact = exactly(way.from, way.to);
    blocked += exact ? 1 : 0;
    if (scene.blocked(way.from, way.to) == exact) return;
    ++all;
    if (!rays::near_edge(way, 0.01, exactly)) ++away;
  });
  return {all, away, blocked};
}

TEST(RayScene, AgreesWithDoublePrecisionOnACasing) {
  const TriangleMesh mesh = barrel();
  const auto found = disagreement(mesh, 40000, [&](RandomStream& r) { return rays::from_surface(mesh, r); });
  EXPECT_EQ(found.away_from_edges, 0);
  EXPECT_LE(found.all, 4);  // the band is thin: one way in ten thousand
  EXPECT_GT(found.blocked, 10000);
  EXPECT_LT(found.blocked, 30000);
}

TEST(RayScene, AgreesWithDoublePrecisionAmongTrianglesInAllPlaces) {
  RandomStream random(5, 0);
  const TriangleMesh mesh = rays::soup(300, random);
  const auto found = disagreement(mesh, 40000, [](RandomStream& r) { return rays::within_soup(r); });
  EXPECT_EQ(found.away_from_edges, 0);
  EXPECT_LE(found.all, 4);
  EXPECT_GT(found.blocked, 10000);
  EXPECT_LT(found.blocked, 36000);
}

TEST(BlockedExactly, HoldsTheEdgesToTheLastDigits) {
  const TriangleMesh mesh = plate(100);
  EXPECT_TRUE(blocked_exactly(mesh, {49.999999, 1, 0}, {49.999999, 1, 200}));
  EXPECT_FALSE(blocked_exactly(mesh, {50.000001, 1, 0}, {50.000001, 1, 200}));
  EXPECT_TRUE(blocked_exactly(mesh, {0, 1, 0}, {0, 1, 100.000001}));
  EXPECT_FALSE(blocked_exactly(mesh, {0, 1, 0}, {0, 1, 99.999999}));
  EXPECT_FALSE(blocked_exactly(mesh, {-100, 1, 100}, {100, 1, 100}));  // within the plane: no crossing
}

TEST(RayScene, LeavesParallelLoopsTheirThreads) {
  const auto most_at_once = [] {
    std::atomic<int> now{0}, most{0};
    parallel_for(64, [&](std::size_t) {
      const int running = ++now;
      for (int seen = most; running > seen && !most.compare_exchange_weak(seen, running);) {
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      --now;
    });
    return most.load();
  };
  const int before = most_at_once();
  const RayScene scene(surface_of_revolution({{1, 0}, {1, 1}}, 12));
  EXPECT_FALSE(scene.empty());
  EXPECT_EQ(most_at_once() > 1, before > 1);
}

}  // namespace
}  // namespace asterism
