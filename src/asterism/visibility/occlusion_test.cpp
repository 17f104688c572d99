// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/occlusion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/visibility/scene_for_tests.hpp"

namespace asterism {
namespace {

/// 1 m before the left camera and facing it, radius 10 mm.
Target disc() {
  Target target;
  target.id = "P1";
  target.position = {0, 0, 1000};
  target.normal = -Vec3::UnitZ();
  target.diameter_mm = 20;
  return target;
}

Obstacle fixed(const std::string& name, const Shape& shape, const Vec3& at) {
  return {name, shape, "", {Quaternion::Identity(), at}, {}};
}

/// A body at the tracker's own place that carries `disc`, and something else that moves.
Cell cell_with(std::vector<Obstacle> obstacles) {
  Cell cell;
  cell.rig = rig_of(CameraPair{});
  cell.movers.push_back({{"body", {disc()}}, at_rest({})});
  cell.movers.push_back({{"scanner", {}}, at_rest({})});
  cell.obstacles = std::move(obstacles);
  return cell;
}

/// 4000 rays: their even spread is well within 1/√4000 of an area.
constexpr double kShareError = 3e-3;
OcclusionOptions many_rays() { return {4000, 0.98, 0}; }

double share_of(const Cell& cell, const Target& target = disc()) {
  return Occlusion(cell, many_rays()).free_share(target, 0, poses_at(cell, 0), Side::Left);
}

TEST(FreeShare, IsOneWithNothingInTheWay) {
  EXPECT_TRUE(Occlusion(cell_with({})).empty());
  EXPECT_EQ(share_of(cell_with({})), 1.0);
  EXPECT_EQ(share_of(cell_with({fixed("aside", Box{{100, 100, 100}}, {200, 0, 500})})), 1.0);
}

TEST(FreeShare, EqualsTheSegmentThatAnEdgeLeaves) {
  // A wide plate halfway, its edge at x = 2 mm there, covers what is beyond x = 4 mm at the disc.
  const double angle = 2 * std::acos(4.0 / 10.0);
  const double covered = (angle - std::sin(angle)) / (2 * std::numbers::pi);
  const Cell cell = cell_with({fixed("edge", Box{{500, 500, 1e-2}}, {252, 0, 500})});
  EXPECT_NEAR(share_of(cell), 1 - covered, kShareError);
}

TEST(FreeShare, EqualsWhatABallLeaves) {
  // The cone of sight that touches a ball of 3 mm halfway covers 6 mm of the disc's 10 mm.
  const Cell cell = cell_with({fixed("ball", Capsule{Vec3::Zero(), Vec3::Zero(), 3}, {0, 0, 500})});
  EXPECT_NEAR(share_of(cell), 1 - 0.36, kShareError);
}

TEST(FreeShare, EqualsWhatAStripLeaves) {
  // 2 mm wide halfway: |x| < 2 mm of the disc.
  const Cell cell = cell_with({fixed("strip", Box{{2, 200, 1e-2}}, {0, 0, 500})});
  const double half = std::asin(0.2);
  EXPECT_NEAR(share_of(cell), 1 - (2 * half + std::sin(2 * half)) / std::numbers::pi, kShareError);
}

TEST(FreeShare, CountsARayOnceWhereSolidsOfSeveralCarriersStandInLine) {
  Cell cell = cell_with({fixed("far", Box{{500, 500, 1e-2}}, {250, 0, 500}),
                         fixed("near", Box{{500, 500, 1e-2}}, {250, 0, 400})});
  cell.obstacles[1].body = "scanner";
  EXPECT_NEAR(share_of(cell), 0.5, kShareError);
}

TEST(FreeShare, TakesATargetWithoutNormalOrDiameterForAPoint) {
  const Cell cell = cell_with({fixed("edge", Box{{500, 500, 1e-2}}, {251, 0, 500})});
  Target bare = disc();
  bare.diameter_mm.reset();
  EXPECT_EQ(share_of(cell, bare), 1.0);
  bare.position.x() = 3;
  EXPECT_EQ(share_of(cell, bare), 0.0);
  bare.normal.reset();
  bare.diameter_mm = 20;
  EXPECT_EQ(share_of(cell, bare), 0.0);
  bare.position.x() = 0;
  EXPECT_EQ(share_of(cell, bare), 1.0);
}

TEST(FreeShare, LetsTheSkinThatCarriesATargetNotHideIt) {
  // The disc lies on the front of a box of its own body.
  Cell cell = cell_with({fixed("skin", Box{{100, 100, 50}}, {0, 0, 1025})});
  cell.obstacles[0].body = "body";
  for (const bool has_normal : {true, false}) {
    Target target = disc();
    if (!has_normal) target.normal.reset();
    EXPECT_EQ(Occlusion(cell).free_share(target, 0, poses_at(cell, 0), Side::Left), 1.0);
    EXPECT_EQ(Occlusion(cell).free_share(target, 0, poses_at(cell, 0), Side::Right), 1.0);
  }
  Target behind = disc();
  behind.position.z() = 1051;
  EXPECT_EQ(Occlusion(cell).free_share(behind, 0, poses_at(cell, 0), Side::Left), 0.0);
}

TEST(HiddenBy, NamesTheSolidThatTakesMostOfTheDisc) {
  // Of the disc's sides, "small" takes what is beyond −6 mm and "large" what is beyond +2 mm.
  const Cell cell = cell_with({fixed("small", Box{{100, 100, 1e-2}}, {-53, 0, 500}),
                               fixed("large", Box{{100, 100, 1e-2}}, {51, 0, 500}),
                               fixed("behind it", Box{{100, 100, 1e-2}}, {51, 0, 700})});
  const Occlusion occlusion(cell);
  ASSERT_EQ(occlusion.names().size(), 3U);
  // From the disc towards the camera, "behind it" is met first.
  EXPECT_EQ(occlusion.hidden_by(disc(), 0, poses_at(cell, 0), Side::Left), 2U);
  EXPECT_EQ(occlusion.names()[2], "behind it");
  EXPECT_EQ(occlusion.hidden_by(disc(), 0, poses_at(cell, 0), Side::Right), std::nullopt);
}

TEST(HiddenBy, CallsATargetFreeWhenEnoughOfItIs) {
  const double angle = 2 * std::acos(0.8);  // 5.2 % are beyond x = 8 mm
  const double covered = (angle - std::sin(angle)) / (2 * std::numbers::pi);
  const Cell cell = cell_with({fixed("edge", Box{{500, 500, 1e-2}}, {254, 0, 500})});
  for (const double share : {0.98, 1 - covered - 0.005, 1 - covered + 0.005}) {
    const Occlusion occlusion(cell, {4000, share, 0});
    const bool hidden = share > 1 - covered;
    EXPECT_EQ(occlusion.hidden_by(disc(), 0, poses_at(cell, 0), Side::Left).has_value(), hidden);
    const std::vector<std::vector<RigidMotion>> poses = {poses_at(cell, 0)};
    EXPECT_EQ(occlusion.unhidden_targets({{disc()}}, 0, poses).seen[0][0] == 0, hidden);
  }
}

/// The paper's targets on a swinging platform, a pillar on it, a scanner that passes, a post that stands.
struct Busy {
  Cell cell;
  std::vector<Target> targets;
  std::vector<std::vector<RigidMotion>> poses;
};
Busy busy() {
  Busy scene;
  Cell& cell = scene.cell;
  cell.rig = scene::rig();
  scene.targets = scene::targets_of(scene::kTable1[0]);
  const auto more = scene::targets_of(scene::kTable9[2]);
  scene.targets.insert(scene.targets.end(), more.begin(), more.end());
  cell.movers.push_back({{"platform", scene.targets}, at_rest({})});
  cell.movers.push_back({{"scanner", {}}, at_rest({})});
  cell.obstacles = {{"pillar", Frustum{90, 60, 500}, "platform", {Quaternion::Identity(), {0, 0, 500}}, {}},
                    {"housing", Box{{200, 150, 100}}, "scanner", {}, {}},
                    fixed("post", Capsule{{0, -500, 0}, {0, 500, 0}, 30}, {-300, 0, 1500})};
  const auto of_platform = scene::motion(cell.rig, 60);
  for (std::size_t i = 0; i < of_platform.size(); ++i) {
    const double share = static_cast<double>(i) / 59.0;
    scene.poses.push_back({of_platform[i], {exp_rotation({0.3, share, 0}), {700 - 1500 * share, 100, 1700}}});
  }
  return scene;
}

TEST(UnhiddenTargets, SaysOfEachPoseWhatFreeShareSays) {
  const Busy scene = busy();
  const OcclusionOptions options;
  const Occlusion occlusion(scene.cell, options);
  const MotionVisibility seen = occlusion.unhidden_targets(scene.targets, 0, scene.poses);
  std::size_t hidden = 0, compared = 0;
  for (std::size_t pose = 0; pose < scene.poses.size(); ++pose) {
    for (const Side side : {Side::Left, Side::Right}) {
      for (std::size_t i = 0; i < scene.targets.size(); ++i) {
        const double share = occlusion.free_share(scene.targets[i], 0, scene.poses[pose], side);
        const bool free = (seen.seen[pose][static_cast<std::size_t>(side)] >> i & 1U) != 0;
        EXPECT_EQ(free, share >= options.least_share);
        EXPECT_EQ(free, !occlusion.hidden_by(scene.targets[i], 0, scene.poses[pose], side).has_value());
        hidden += free ? 0 : 1;
        ++compared;
      }
    }
  }
  EXPECT_GT(hidden, compared / 20);  // both happen
  EXPECT_LT(hidden, compared / 2);
}

TEST(UnhiddenTargets, AsksNoMoreThanItMustForTheSameAnswer) {
  const Busy scene = busy();
  const Occlusion occlusion(scene.cell);
  std::vector<RigidMotion> of_platform;
  for (const auto& pose : scene.poses) of_platform.push_back(pose[0]);
  VisibilityOptions options;
  options.max_incidence_deg = 40;
  const auto seen = visible_targets(scene.targets, of_platform, scene.cell.rig, {}, options);
  const auto joined = common(seen, occlusion.unhidden_targets(scene.targets, 0, scene.poses));
  EXPECT_EQ(occlusion.unhidden_of(seen, scene.targets, 0, scene.poses).seen, joined.seen);
  EXPECT_NE(joined.seen, seen.seen);
  EXPECT_EQ(Occlusion(Cell{}).unhidden_of(seen, scene.targets, 0, scene.poses).seen, seen.seen);
}

TEST(UnhiddenTargets, DoesNotDependOnWhereTheBodysFrameLies) {
  Busy scene = busy();
  const auto before = Occlusion(scene.cell).unhidden_targets(scene.targets, 0, scene.poses);
  const RigidMotion elsewhere{rotation_from_yaw_pitch_roll(1, 0.4, -2), {900, -800, 1200}};
  for (Target& target : scene.targets) {
    target.position = elsewhere * target.position;
    target.normal = elsewhere.rotation * *target.normal;
  }
  scene.cell.obstacles[0].carrier_from_shape = elsewhere * scene.cell.obstacles[0].carrier_from_shape;
  for (auto& pose : scene.poses) pose[0] = pose[0] * elsewhere.inverse();
  const auto after = Occlusion(scene.cell).unhidden_targets(scene.targets, 0, scene.poses);
  // Single precision and another start of the sunflower: only discs that an edge just grazes may change.
  int changed = 0;
  for (std::size_t pose = 0; pose < scene.poses.size(); ++pose) {
    for (std::size_t side = 0; side < 2; ++side) {
      changed += std::popcount(before.seen[pose][side] ^ after.seen[pose][side]);
    }
  }
  EXPECT_LE(changed, 2);
}

TEST(UnhiddenTargets, IsTheSameOnAnyNumberOfThreads) {
  const Busy scene = busy();
  const Occlusion occlusion(scene.cell);
  const auto all = occlusion.unhidden_targets(scene.targets, 0, scene.poses);
  for (const int threads : {1, 2, 3}) {
    set_thread_count(threads);
    EXPECT_EQ(occlusion.unhidden_targets(scene.targets, 0, scene.poses).seen, all.seen);
  }
  set_thread_count(0);
}

TEST(Occlusion, RefusesOptionsOutsideTheirLimits) {
  EXPECT_THROW(Occlusion(cell_with({}), {0, 0.98, 0.5}), InputError);
  EXPECT_THROW(Occlusion(cell_with({}), {16, 1.5, 0.5}), InputError);
}

}  // namespace
}  // namespace asterism
