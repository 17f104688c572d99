// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "asterism/core/parallel.hpp"
#include "asterism/visibility/availability.hpp"
#include "asterism/visibility/scene_for_tests.hpp"

namespace asterism {
namespace {

/// The set that fits Fig. 20 of the paper: eight targets on a ring of 300 mm, z = 600 ± 10 mm, tilted
/// outwards by 20°; a tracker 2 m from the ring's centre, 60° up; ±15° about two axes in the middle of 14 s.
Cell figure_20(double baseline_mm = 1) {
  Cell cell;
  cell.rig = rig_of({4096, 4096, 4400, baseline_mm, 2000});  // half a field of 25°
  Body platform{"platform", {}};
  for (int i = 0; i < 8; ++i) {
    const double azimuth = rad_from_deg(22.5 + 45 * i), tilt = rad_from_deg(20);
    const Vec3 outwards(std::cos(azimuth), std::sin(azimuth), 0);
    Target target;
    target.id = "P" + std::to_string(i + 1);
    target.position = 300 * outwards + Vec3(0, 0, i % 2 == 0 ? 610 : 590);
    target.normal = std::sin(tilt) * outwards + std::cos(tilt) * Vec3::UnitZ();
    target.diameter_mm = 10;
    platform.targets.push_back(target);
  }
  Sweep sweep;
  sweep.tracker_from_rest =
      tracker_from_frame({{0, 0, 600}, 2000, rad_from_deg(60), rad_from_deg(45)}, cell.rig);
  sweep.roll = {rad_from_deg(15), 0.5, 0};
  sweep.pitch = {rad_from_deg(15), 0.25, 0};
  cell.movers.push_back({platform, sweep});
  cell.platform = Platform{};
  return cell;
}

std::vector<double> times(double to_s, int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(to_s * i / (count - 1));
  return all;
}

TEST(CoverageCoefficient, EqualsTheCosineAtRest) {
  const Cell cell = figure_20();
  const RigidMotion rest = std::get<Sweep>(cell.movers[0].motion).tracker_from_rest;
  EXPECT_NEAR(coverage_coefficient(cell, rest, {0, 0, 600}), std::sin(rad_from_deg(60)), 1e-9);
  EXPECT_NEAR(coverage_coefficient(cell, rest, {0, 0, 600}), 0.866, 5e-4);  // as the figure shows
}

TEST(CoverageCoefficient, IsNothingWhereTheCentreIsNotInView) {
  Cell cell = figure_20();
  const RigidMotion rest = std::get<Sweep>(cell.movers[0].motion).tracker_from_rest;
  EXPECT_EQ(coverage_coefficient(cell, rest, {2000, 0, 600}), 0);
  cell.volume = WorkingVolume{500, 1900, 800, 600, 2600, 2000};
  EXPECT_EQ(coverage_coefficient(cell, rest, {0, 0, 600}), 0);
  cell.volume->far_mm = 2100;
  EXPECT_NEAR(coverage_coefficient(cell, rest, {0, 0, 600}), 0.866, 5e-4);
}

TEST(WatchCell, FitsFigure20) {
  const Cell cell = figure_20();
  const WatchedCell watched = watch_cell(cell, times(4, 201), {}, Occlusion(cell));
  const auto counts = visible_counts(watched.bodies[0].visibility);
  EXPECT_EQ(counts.front(), 8);  // at rest
  EXPECT_EQ(std::set<int>(counts.begin(), counts.end()), (std::set<int>{4, 5, 6, 7, 8}));
  EXPECT_EQ(first_pose_below(watched.bodies[0].visibility), std::nullopt);
  const auto [least, most] = std::minmax_element(watched.coverage.begin(), watched.coverage.end());
  EXPECT_NEAR(*least, 0.606, 1e-3);  // printed to three decimals
  EXPECT_NEAR(*most, 0.994, 1e-3);
}

/// A wall of the tracker's frame between the left camera and all targets, and a rod on the platform.
Cell walled() {
  Cell cell = figure_20(1000);
  cell.obstacles.push_back({"wall", Box{{200, 1000, 10}}, "", {Quaternion::Identity(), {0, 0, 500}}, {}});
  return cell;
}

TEST(WatchCell, NamesEachCause) {
  Cell cell = walled();
  cell.movers[0].body.targets.push_back(cell.movers[0].body.targets[0]);
  Target& away = cell.movers[0].body.targets.back();
  away.id = "P9";
  away.position.z() -= 50;
  away.normal = -*away.normal;
  const Occlusion occlusion(cell);
  const WatchedCell watched = watch_cell(cell, times(4, 41), {}, occlusion);
  const WatchedBody& body = watched.bodies[0];
  ASSERT_EQ(body.causes.size(), 41U);
  ASSERT_EQ(body.causes[0].size(), 9U);
  EXPECT_EQ(body.causes[0][8][0].fails, SightFailure::TooOblique);
  EXPECT_EQ(body.causes[0][8][0].solid, std::nullopt);
  int hidden = 0;
  for (std::size_t pose = 0; pose < body.causes.size(); ++pose) {
    for (std::size_t i = 0; i < 9; ++i) {
      for (std::size_t side = 0; side < 2; ++side) {
        const SightCause& cause = body.causes[pose][i][side];
        EXPECT_EQ(cause.seen(), (body.visibility.seen[pose][side] >> i & 1U) != 0);
        EXPECT_EQ(cause.solid.has_value(), cause.fails == SightFailure::Hidden);
        if (!cause.solid) continue;
        EXPECT_EQ(occlusion.names()[*cause.solid], "wall");
        EXPECT_EQ(side, 0U);
        ++hidden;
      }
    }
  }
  EXPECT_GT(hidden, 100);
  EXPECT_EQ(text_of(SightFailure::Hidden), "hidden");
}

TEST(WatchCell, SaysWhatTheTwoHalvesSayTogether) {
  Cell cell = walled();
  cell.obstacles.push_back(
      {"rod", Capsule{{0, 0, 0}, {0, 0, 500}, 60}, "platform", {Quaternion::Identity(), {0, 0, 600}}, {}});
  const Occlusion occlusion(cell);
  const WatchedCell watched = watch_cell(cell, times(4, 41), {}, occlusion);
  std::vector<RigidMotion> of_platform;
  for (const auto& poses : watched.poses) of_platform.push_back(poses[0]);
  const auto& targets = cell.movers[0].body.targets;
  const auto both = common(visible_targets(targets, of_platform, cell.rig, cell.volume, {}),
                           occlusion.unhidden_targets(targets, 0, watched.poses));
  EXPECT_EQ(watched.bodies[0].visibility.seen, both.seen);
}

TEST(WatchCell, IsTheSameOnAnyNumberOfThreads) {
  const Cell cell = walled();
  const Occlusion occlusion(cell);
  const WatchedCell all = watch_cell(cell, times(4, 50), {}, occlusion);
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    const WatchedCell again = watch_cell(cell, times(4, 50), {}, occlusion);
    EXPECT_EQ(again.bodies[0].visibility.seen, all.bodies[0].visibility.seen);
    EXPECT_EQ(again.coverage, all.coverage);
  }
  set_thread_count(0);
}

TEST(WatchCell, LeavesTheCoverageOutWithoutAPlatform) {
  Cell cell = figure_20();
  cell.platform.reset();
  EXPECT_TRUE(watch_cell(cell, times(1, 3), {}, Occlusion(cell)).coverage.empty());
}

TEST(CountHidden, CountsPosesBySolid) {
  const Cell cell = walled();
  const Occlusion occlusion(cell);
  const WatchedCell watched = watch_cell(cell, times(4, 41), {}, occlusion);
  const HiddenCounts counts = count_hidden(watched.bodies[0], occlusion.names().size());
  ASSERT_EQ(counts.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    int expected = 0;
    for (const auto& causes : watched.bodies[0].causes) {
      expected += causes[i][0].fails == SightFailure::Hidden ? 1 : 0;
    }
    EXPECT_EQ(counts[i][0], std::vector<int>{expected});
    EXPECT_EQ(counts[i][1], std::vector<int>{0});  // the wall stands before the left camera alone
  }
  EXPECT_EQ(first_pose_below(watched.bodies[0].visibility), 0U);
}

TEST(AttitudeMap, HasTheRestInItsMiddleAndTheMotionsExtremesAtItsRim) {
  const Cell cell = figure_20();
  const Occlusion occlusion(cell);
  const AttitudeMap map = attitude_map(cell, 0, 15, 31, {}, occlusion);
  ASSERT_EQ(map.visible.size(), 31U);
  ASSERT_EQ(map.visible.front().size(), 31U);
  EXPECT_EQ(map.visible[15][15], 8);
  EXPECT_DOUBLE_EQ(map.roll_deg.front(), -15);
  EXPECT_DOUBLE_EQ(map.pitch_deg[15], 0);
  const RigidMotion rest = std::get<Sweep>(cell.movers[0].motion).tracker_from_rest;
  const RigidMotion corner =
      rest * RigidMotion{rotation_from_yaw_pitch_roll(0, rad_from_deg(-15), rad_from_deg(15)), Vec3::Zero()};
  const auto& targets = cell.movers[0].body.targets;
  const auto expected = visible_targets(targets, std::vector{corner}, cell.rig, cell.volume, {});
  EXPECT_EQ(map.seen_by_both[0][30], expected.both(0));  // pitch −15°, roll +15°
  EXPECT_EQ(map.visible[0][30], std::popcount(expected.both(0)));
}

TEST(AttitudeMap, KnowsWhatHides) {
  const Cell cell = walled();
  const AttitudeMap map = attitude_map(cell, 0, 10, 5, {}, Occlusion(cell));
  EXPECT_LT(map.visible[2][2], 8);
}

}  // namespace
}  // namespace asterism
