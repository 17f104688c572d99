// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/shadows.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/layout/cell_for_tests.hpp"
#include "asterism/layout/surface.hpp"

namespace asterism {
namespace {

struct Asked {
  Occlusion occlusion;
  std::vector<std::vector<RigidMotion>> poses;
};
Asked asked(const Cell& cell) {
  Asked all{Occlusion(cell), {}};
  for (int i = 0; i < cell.layout->poses; ++i) {
    all.poses.push_back(poses_at(cell, 4.0 * i / (cell.layout->poses - 1)));
  }
  return all;
}

std::vector<Target> targets_on(const DeployableSurface& surface, std::uint64_t seed) {
  RandomStream random(seed, 0);
  std::vector<Target> targets;
  for (int i = 0; i < 60; ++i) {
    const Place place = *random_place(surface, 0, random);
    targets.push_back({"", place.position_mm, place.normal, 12.0, {}});
  }
  return targets;
}

struct Compared {
  int sights = 0, hidden = 0, hidden_in_table_alone = 0, missed_by_table = 0;
};
Compared compared(const DeployableSurface& surface, std::size_t places) {
  const Asked all = asked(shaded_cell());
  const Shadows shadows(surface, 12, all.occlusion, 0, all.poses, places);
  EXPECT_LE(shadows.places(), places);
  Compared sum;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto targets = targets_on(surface, seed);
    const TargetMask every = (TargetMask{1} << targets.size()) - 1;
    const MotionVisibility whole{std::vector(all.poses.size(), std::array{every, every})};
    const auto exact = all.occlusion.unhidden_of(whole, targets, 0, all.poses);
    const auto table = shadows.unhidden_of(whole, targets);
    for (std::size_t pose = 0; pose < all.poses.size(); ++pose) {
      for (std::size_t side = 0; side < 2; ++side) {
        const TargetMask really = exact.seen[pose][side], told = table.seen[pose][side];
        sum.sights += static_cast<int>(targets.size());
        sum.hidden += std::popcount(every & ~really);
        sum.hidden_in_table_alone += std::popcount(really & ~told);
        sum.missed_by_table += std::popcount(told & ~really);
      }
    }
  }
  return sum;
}

DeployableSurface one(const Patch& patch) { return {{{"patch", patch}}, {}}; }

TEST(Shadows, HideAllThatIsHiddenAndAStepBesides) {
  const std::vector<DeployableSurface> surfaces = {
      one(Annulus{{0, 0, 600}, 150, 400}),
      one(Annulus{{0, 0, 600}, 0, 350, 0.5, 4}),
      one(CylinderSide{{0, 0, 500}, 380, 120, -1, 2.5}),
      one(Plate{{rotation_from_yaw_pitch_roll(0.4, 0.2, -0.1), {60, -80, 600}}, 500, 350}),
      one(CylinderRoom{{0, 0, 580}, 350, 40, rad_from_deg(20)}),
      {{{"ring", Annulus{{0, 0, 600}, 250, 400}}, {"side", CylinderSide{{0, 0, 500}, 400, 100}}}, {}}};
  for (const DeployableSurface& surface : surfaces) {
    const Compared sum = compared(surface, 3000);
    EXPECT_GT(sum.hidden, 100) << surface.patches[0].patch.index();
    EXPECT_LE(sum.missed_by_table, sum.sights / 2000) << surface.patches[0].patch.index();
    EXPECT_LT(sum.hidden_in_table_alone, sum.sights / 10) << surface.patches[0].patch.index();
  }
}

TEST(Shadows, AreTruerTheMorePlacesTheyAreAskedAt) {
  const auto ring = one(Annulus{{0, 0, 600}, 150, 400});
  const int coarse = compared(ring, 300).hidden_in_table_alone;
  const int fine = compared(ring, 4800).hidden_in_table_alone;
  EXPECT_LT(fine, 0.4 * coarse);  // a step a quarter as wide
}

TEST(Shadows, AreExactAtThePlacesThemselves) {
  const Asked all = asked(shaded_cell());
  const Plate plate{{Quaternion::Identity(), {0, 0, 600}}, 600, 0};  // a line: places along x alone
  const Shadows shadows(one(plate), 12, all.occlusion, 0, all.poses, 61);
  const std::size_t count = shadows.places();
  ASSERT_GT(count, 50U);
  const double step = 600.0 / static_cast<double>(count - 1);
  const auto at = [](double x) { return Target{"", {x, 0, 600}, Vec3::UnitZ(), 12.0, {}}; };
  std::vector<Target> places, between;
  for (std::size_t i = 0; i < count; ++i) places.push_back(at(-300 + step * static_cast<double>(i)));
  for (std::size_t i = 0; i + 1 < count; ++i) between.push_back(at(places[i].position.x() + 0.3 * step));
  const TargetMask every = (TargetMask{1} << count) - 1;
  const MotionVisibility whole{std::vector(all.poses.size(), std::array{every, every})};
  const auto exact = all.occlusion.unhidden_of(whole, places, 0, all.poses);
  const auto table = shadows.unhidden_of(whole, between);
  int hidden = 0;
  for (std::size_t pose = 0; pose < all.poses.size(); ++pose) {
    for (std::size_t side = 0; side < 2; ++side) {
      const TargetMask both_ends = exact.seen[pose][side] & exact.seen[pose][side] >> 1;
      EXPECT_EQ((table.seen[pose][side] ^ both_ends) & (every >> 1), 0U);
      hidden += std::popcount(every & ~exact.seen[pose][side]);
    }
  }
  EXPECT_GT(hidden, 30);
}

TEST(Shadows, AreNoneWhereNothingHides) {
  Cell cell = shaded_cell();
  cell.obstacles.clear();
  const Asked all = asked(cell);
  const Shadows shadows(cell.layout->surface, 12, all.occlusion, 0, all.poses, 3000);
  EXPECT_TRUE(shadows.empty());
  const MotionVisibility seen{{{0b101, 0b011}}};
  EXPECT_EQ(shadows.unhidden_of(seen, {}).seen, seen.seen);
}

TEST(Shadows, AreTheSameOnAnyNumberOfThreads) {
  const Asked all = asked(shaded_cell());
  const auto surface = one(Annulus{{0, 0, 600}, 150, 400});
  const auto targets = targets_on(surface, 1);
  const TargetMask every = (TargetMask{1} << targets.size()) - 1;
  const MotionVisibility whole{std::vector(all.poses.size(), std::array{every, every})};
  const auto once = Shadows(surface, 12, all.occlusion, 0, all.poses, 1000).unhidden_of(whole, targets);
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    const Shadows again(surface, 12, all.occlusion, 0, all.poses, 1000);
    EXPECT_EQ(again.unhidden_of(whole, targets).seen, once.seen);
  }
  set_thread_count(0);
}

}  // namespace
}  // namespace asterism
