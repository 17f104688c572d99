// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asterism/cell/occluders.hpp"

namespace asterism {
namespace {

RigidMotion shifted(double x, double y, double z) { return {Quaternion::Identity(), {x, y, z}}; }

/// One disc of 10 mm radius that faces the left camera squarely at 2 m, and what stands before it.
Cell disc_behind(const std::vector<Obstacle>& obstacles) {
  Cell cell;
  cell.rig = rig_of({});
  cell.movers.push_back(
      {{"plate", {{"T", {0, 0, 0}, Vec3(0, 0, -1), 20.0, {}}}}, at_rest(shifted(0, 0, 2000))});
  cell.obstacles = obstacles;
  return cell;
}

double share_in(const Cell& cell, double time_s = 0) {
  const Stage stage = stage_of(cell);
  return visible_share(scene_of(stage, Side::Left, time_s), 0, cell.rig.left);
}
double share_seen(const std::vector<Obstacle>& obstacles) { return share_in(disc_behind(obstacles)); }

/// A mesh that stands in the tracker's frame, or moves with a body.
Solid solid_of(const Shape& shape, const RigidMotion& place, const std::string& body = "") {
  return {"solid", std::make_shared<const TriangleMesh>(mesh_of(shape)), body, place, {}};
}

// 4000 points, those of a sunflower being more even than chance: well below 1/√4000.
constexpr double kShareError = 3e-3;

TEST(VisibleShare, IsOneWithNothingInTheWay) { EXPECT_EQ(share_seen({}), 1.0); }

TEST(VisibleShare, EqualsTheSegmentThatAnEdgeLeaves) {
  // A wide box halfway, its edge at x = 2 mm there, covers what is beyond x = 4 mm at the disc.
  const Obstacle edge{"edge", Box{{500, 500, 1e-3}}, "", shifted(252, 0, 1000), {}};
  const double angle = 2 * std::acos(4.0 / 10.0);
  const double segment = (angle - std::sin(angle)) / (2 * std::numbers::pi);
  EXPECT_NEAR(share_seen({edge}), 1 - segment, kShareError);
}

TEST(VisibleShare, EqualsTheRingAroundABall) {
  // Halfway, a ball of a quarter of the disc's radius casts a shadow of half of it: a quarter of the area.
  const Obstacle ball{"ball", Capsule{{0, 0, 0}, {0, 0, 0}, 2.5}, "", shifted(0, 0, 1000), {}};
  EXPECT_NEAR(share_seen({ball}), 0.75, kShareError);
}

TEST(VisibleShare, EqualsTheStripsBesideARod) {
  const Obstacle rod{"rod", Capsule{{0, -100, 0}, {0, 100, 0}, 2}, "", shifted(0, 0, 1000), {}};
  const double half = 4.0 / 10.0;  // of the strip, in radii
  const double strip = 2 / std::numbers::pi * (half * std::sqrt(1 - half * half) + std::asin(half));
  EXPECT_NEAR(share_seen({rod}), 1 - strip, kShareError);
}

TEST(VisibleShare, SeesThroughNeitherEndOfACone) {
  // A cone along the line of sight: its wider, nearer end hides half the radius.
  const Frustum cone{2.5, 0.5, 50};
  EXPECT_NEAR(share_seen({{"cone", cone, "", shifted(0, 0, 1000), {}}}), 0.75, kShareError);
  EXPECT_EQ(share_seen({{"behind", cone, "", shifted(0, 0, 2010), {}}}), 1.0);
}

TEST(VisibleShare, IsHalfOnTheImagesEdge) {
  Cell cell = disc_behind({});
  cell.movers[0].motion = at_rest(shifted(-(1023.5 + 0.5) / 3200 * 2000, 0, 2000));
  EXPECT_NEAR(share_in(cell), 0.5, kShareError);
}

TEST(VisibleShare, IsNothingFromBehind) {
  Cell cell = disc_behind({});
  cell.movers[0].body.targets[0].normal = Vec3::UnitZ();
  EXPECT_EQ(share_in(cell), 0.0);
}

TEST(VisibleShare, CountsAnotherBodysTargetInFront) {
  Cell cell = disc_behind({});
  cell.movers.push_back(
      {{"front", {{"F", {0, 0, 0}, Vec3(0, 0, -1), 5.0, {}}}}, at_rest(shifted(0, 0, 1000))});
  EXPECT_NEAR(share_in(cell), 0.75, kShareError);
}

TEST(VisibleShare, OfDiscsBehindAMeshEqualsThatBehindTheSameBox) {
  const Box box{{30, 500, 40}};
  for (int i = 0; i < 40; ++i) {
    const RigidMotion place = {exp_rotation({0.02 * i, 0.1, -0.03 * i}), {-24 + 1.2 * i, 0, 1000}};
    Cell cell = disc_behind({});
    cell.fixtures = {solid_of(box, place)};
    // The same points are asked; single precision moves an edge by 0.0002 mm: one point of 4000 at most.
    EXPECT_NEAR(share_in(cell), share_seen({{"box", box, "", place, {}}}), 1.01 / 4000) << i;
  }
}

TEST(VisibleShare, CountsTheWorkpieceWhereItsBodyHasCarriedIt) {
  Cell cell = disc_behind({});
  cell.movers.push_back({{"arm", {{"A", {0, 0, 500}, {}, {}, {}}}},
                         KeyedMotion{{{0, shifted(400, 0, 1000)}, {1, shifted(0, 0, 1000)}}}});
  cell.workpiece = solid_of(Capsule{{0, 0, 0}, {0, 0, 0}, 2.5}, {}, "arm");
  EXPECT_EQ(share_in(cell, 0), 1.0);
  // The polygons of 96 sides leave 0.2 % of the ball's disc.
  EXPECT_NEAR(share_in(cell, 1), 0.75, kShareError);
}

TEST(VisibleShare, IsOneOnTheSkinOfAMeshThatCarriesTheTarget) {
  Cell cell = disc_behind({});
  cell.movers[0].body.targets[0].normal = Vec3(0.5, 0, -std::sqrt(0.75));
  const RigidMotion tilted = {exp_rotation({0, -rad_from_deg(30), 0}), {0, 0, 0}};
  cell.workpiece = solid_of(Box{{300, 300, 50}}, tilted * shifted(0, 0, 25), "plate");
  EXPECT_EQ(share_in(cell), 1.0);
}

TEST(VisibleShare, IsNothingOnceTheTargetHasFallenOff) {
  Cell cell = disc_behind({});
  cell.faults = {{FaultKind::FallsOff, "plate", "T", 0.5, {}}};
  EXPECT_EQ(share_in(cell, 0.49), 1.0);
  EXPECT_EQ(share_in(cell, 0.5), 0.0);
}

TEST(VisibleShare, LooksThroughThePlaceOfATargetThatFellOff) {
  Cell cell = disc_behind({});
  cell.movers.push_back(
      {{"front", {{"F", {0, 0, 0}, Vec3(0, 0, -1), 5.0, {}}}}, at_rest(shifted(0, 0, 1000))});
  cell.faults = {{FaultKind::FallsOff, "front", "F", 1, {}}};
  EXPECT_NEAR(share_in(cell, 0), 0.75, kShareError);
  EXPECT_EQ(share_in(cell, 1), 1.0);
}

TEST(SceneOf, MovesAnObstacleWithItsBody) {
  Cell cell = disc_behind({{"post", Box{{1, 1, 1}}, "plate", shifted(30, 0, 0), {}}});
  const Scene scene = scene_of(stage_of(cell), Side::Left, 0);
  EXPECT_LT((scene.solids[0].ball.centre - Vec3(30, 0, 2000)).norm(), 1e-12);
}

TEST(SceneOf, DimsRetroReflectorsWithIncidenceAndLeavesPaintedOnesAlone) {
  Cell cell = disc_behind({});
  cell.movers[0].body.targets[0].normal = Vec3(std::sin(rad_from_deg(52)), 0, -std::cos(rad_from_deg(52)));
  EXPECT_NEAR(scene_of(stage_of(cell), Side::Left, 0).discs[0].incidence_rad, rad_from_deg(52), 1e-12);
  EXPECT_NEAR(scene_of(stage_of(cell), Side::Left, 0).discs[0].brightness, std::exp(-1.0), 1e-12);
  cell.light.retro_falloff_deg = 0;
  EXPECT_EQ(scene_of(stage_of(cell), Side::Left, 0).discs[0].brightness, 1.0);
}

TEST(SegmentDistance, KnowsCrossingParallelAndPointCases) {
  EXPECT_NEAR(segment_distance({0, 0, 0}, {2, 0, 0}, {1, -1, 3}, {1, 1, 3}), 3, 1e-12);
  EXPECT_NEAR(segment_distance({0, 0, 0}, {2, 0, 0}, {5, 4, 0}, {9, 4, 0}), 5, 1e-12);
  EXPECT_NEAR(segment_distance({0, 0, 0}, {2, 0, 0}, {1, 7, 0}, {1, 7, 0}), 7, 1e-12);
}

}  // namespace
}  // namespace asterism
