// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace asterism {
namespace {

DeployableSurface one(Patch patch) { return {{{"only", std::move(patch)}}, {}}; }

std::vector<DeployableSurface> every_kind() {
  const double pi = std::numbers::pi;
  const RigidMotion aslant = {exp_rotation({0.4, -1.1, 0.7}), Vec3(100, -200, 300)};
  return {one(CylinderSide{{10, 20, 30}, 200, 80, 0.5, 0.5 + pi}),
          one(CylinderSide{{10, 20, 30}, 200, 80}),
          one(Annulus{{10, 20, 30}, 100, 250, -1.0, 1.5}),
          one(Annulus{{10, 20, 30}, 0, 250}),
          one(Plate{aslant, 300, 100}),
          one(CylinderRoom{{0, 0, 580}, 350, 40, 0.35})};
}

TEST(NearestPlace, IsNoFartherThanAnyOtherPlace) {
  RandomStream random(3, 0);
  for (const auto& surface : every_kind()) {
    for (int trial = 0; trial < 100; ++trial) {
      const Vec3 point(random.uniform(-600, 600), random.uniform(-600, 600), random.uniform(-100, 800));
      const Place nearest = nearest_place(surface, point);
      EXPECT_NEAR(nearest.normal.norm(), 1, 1e-12);
      const double distance = (nearest.position_mm - point).norm();
      for (int other = 0; other < 50; ++other) {
        const Place place = *random_place(surface, 0, random);
        EXPECT_GE((place.position_mm - point).norm(), distance - 1e-9);
      }
    }
  }
}

TEST(NearestPlace, OfAPlaceIsItself) {
  RandomStream random(4, 0);
  for (const auto& surface : every_kind()) {
    for (int trial = 0; trial < 100; ++trial) {
      const Place place = *random_place(surface, 0, random);
      const Place again = nearest_place(surface, place.position_mm);
      EXPECT_LT((again.position_mm - place.position_mm).norm(), 1e-9);
      EXPECT_LT((again.normal - place.normal).norm(), 1e-9);
    }
  }
}

TEST(NearestPlace, FacesAsItsPatchDoes) {
  const Place side = nearest_place(one(CylinderSide{{0, 0, 0}, 100, 50}), {0, -300, 20});
  EXPECT_LT((side.position_mm - Vec3(0, -100, 20)).norm(), 1e-9);
  EXPECT_LT((side.normal - Vec3(0, -1, 0)).norm(), 1e-12);
  const Place room = nearest_place(one(CylinderRoom{{0, 0, 580}, 350, 40, rad_from_deg(20)}), {200, 0, 600});
  EXPECT_LT((room.normal - Vec3(std::sin(rad_from_deg(20)), 0, std::cos(rad_from_deg(20)))).norm(), 1e-12);
}

TEST(NearestPlace, ChoosesAmongPatches) {
  DeployableSurface surface = one(Annulus{{0, 0, 0}, 0, 100});
  surface.patches.push_back({"side", CylinderSide{{0, 0, -200}, 100, 200}});
  EXPECT_EQ(nearest_place(surface, {0, 0, 50}).patch, 0U);
  EXPECT_EQ(nearest_place(surface, {150, 0, -60}).patch, 1U);
}

TEST(RandomPlace, IsSpreadEvenlyOverTheArea) {
  // A ring's inner half by radius holds (200² − 100²)/(300² − 100²) = 3/8 of its area.
  const auto ring = one(Annulus{{0, 0, 0}, 100, 300});
  RandomStream random(5, 0);
  int inner = 0;
  for (int i = 0; i < 8000; ++i) inner += random_place(ring, 0, random)->position_mm.norm() < 200 ? 1 : 0;
  EXPECT_NEAR(inner, 3000, 4 * std::sqrt(8000.0 * 3 / 8 * 5 / 8));
  // Two plates, one of three times the other's area.
  DeployableSurface plates = one(Plate{{}, 100, 100});
  plates.patches.push_back({"large", Plate{{Quaternion::Identity(), {500, 0, 0}}, 300, 100}});
  int large = 0;
  for (int i = 0; i < 4000; ++i) large += random_place(plates, 0, random)->patch == 1U ? 1 : 0;
  EXPECT_NEAR(large, 3000, 4 * std::sqrt(4000.0 * 3 / 16));
}

TEST(RandomPlace, StaysOutOfKeepOuts) {
  auto surface = one(Annulus{{0, 0, 0}, 0, 200});
  surface.keep_outs.push_back({"eye", Capsule{{0, 0, 0}, {0, 0, 10}, 80}, {}});
  RandomStream random(6, 0);
  for (int i = 0; i < 500; ++i) EXPECT_GE(random_place(surface, 6, random)->position_mm.norm(), 86);
  surface.keep_outs.push_back({"all", Box{{1000, 1000, 1000}}, {}});
  EXPECT_FALSE(random_place(surface, 6, random));
}

TEST(NearestAllowedPlace, GoesToTheEdgeOfTheKeepOut) {
  auto surface = one(Annulus{{0, 0, 0}, 0, 400});
  surface.keep_outs.push_back({"eye", Capsule{{0, 0, 0}, {0, 0, 10}, 80}, {}});
  const auto place = nearest_allowed_place(surface, {30, 10, 5}, 6);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->position_mm.norm(), 86, 0.01);
  EXPECT_LT((place->position_mm - Vec3(30, 10, 0)).norm(), 1.1 * (86 - std::hypot(30, 10)));
  EXPECT_LT((nearest_allowed_place(surface, {300, 10, 5}, 6)->position_mm - Vec3(300, 10, 0)).norm(), 1e-9);
  surface.keep_outs.push_back({"all", Box{{1000, 1000, 1000}}, {}});
  EXPECT_FALSE(nearest_allowed_place(surface, {30, 10, 5}, 6));
}

TEST(AreaMm2, IsThatOfEachKind) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(area_mm2(CylinderSide{Vec3::Zero(), 100, 50}), 2 * pi * 5000, 1e-6);
  EXPECT_NEAR(area_mm2(Annulus{Vec3::Zero(), 50, 100}), pi * 7500, 1e-6);
  EXPECT_NEAR(area_mm2(Plate{{}, 20, 30}), 600, 1e-9);
  EXPECT_NEAR(area_mm2(CylinderRoom{Vec3::Zero(), 100, 40}), pi * 10000, 1e-6);
}

TEST(BoundsOf, HoldAllPlaces) {
  RandomStream random(7, 0);
  for (const auto& surface : every_kind()) {
    const Bounds bounds = bounds_of(surface);
    for (int i = 0; i < 200; ++i) {
      const Vec3 at = random_place(surface, 0, random)->position_mm;
      EXPECT_TRUE(((at - bounds.lowest).array() >= -1e-9).all() &&
                  ((bounds.highest - at).array() >= -1e-9).all());
    }
  }
}

}  // namespace
}  // namespace asterism
