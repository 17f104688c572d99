// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/render.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "asterism/camera/disc_image.hpp"
#include "asterism/simulation/scene.hpp"
#include "asterism/simulation/test_cell.hpp"
#include "asterism/simulation/truth.hpp"

namespace asterism {
namespace {

/// Light of a window above (or below) a level: its sum and centroid.
struct Spot {
  double sum = 0;
  Vec2 centroid = Vec2::Zero();
};

Spot spot_around(const Raster<float>& light, const Vec2& centre, int reach, double background) {
  Spot spot;
  const int cx = static_cast<int>(std::lround(centre.x())), cy = static_cast<int>(std::lround(centre.y()));
  for (int y = std::max(0, cy - reach); y <= std::min(light.height - 1, cy + reach); ++y) {
    for (int x = std::max(0, cx - reach); x <= std::min(light.width - 1, cx + reach); ++x) {
      const double value = light.at(x, y) - background;
      spot.sum += value;
      spot.centroid += value * Vec2(x, y);
    }
  }
  spot.centroid /= spot.sum;
  return spot;
}

Cell distorted_cell() {
  Cell cell = test_cell();
  for (Lens* lens : {&cell.rig.left, &cell.rig.right}) {
    lens->coefficients = 5;
    lens->distortion = {-0.25, 0.11, 0.0012, -0.0008, -0.02};
  }
  return cell;
}

class DrawnDiscs : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(BlurPx, DrawnDiscs, testing::Values(0.55, 0.8, 2.5));

/// Holds each disc's light against the conic that camera/ says it has.
void check_against_conics(const Cell& cell, Side side, double time_s) {
  const Raster<float> light = render_light(stage_of(cell), side, time_s, 1, 0);
  const Scene scene = scene_of(stage_of(cell), side, time_s);
  for (const SceneDisc& disc : scene.discs) {
    const auto conic =
        image_of_disc(cell.rig.lens(side), {disc.place.centre, disc.place.normal, disc.place.radius_mm});
    ASSERT_TRUE(conic);
    const int reach = static_cast<int>(conic->semi_major + 6 * cell.sensor.blur_px) + 3;
    const Spot spot = spot_around(light, conic->centre, reach, cell.light.background_level);
    EXPECT_LT((spot.centroid - conic->centre).norm(), 1e-3);
    const double area = std::numbers::pi * conic->semi_major * conic->semi_minor;
    const double level = cell.light.target_level * disc.brightness - cell.light.background_level;
    EXPECT_NEAR(spot.sum / (area * level), 1, 3e-4);  // the ellipse's area through the linearised lens
  }
}

TEST_P(DrawnDiscs, HaveTheirConicsCentreToAThousandthOfAPixelAndAllTheirLight) {
  Cell cell = distorted_cell();
  cell.sensor.blur_px = GetParam();
  cell.sensor.exposure_s = 0;
  for (const double time_s : {0.0, 0.41, 1.3}) {
    check_against_conics(cell, Side::Left, time_s);
    check_against_conics(cell, Side::Right, time_s);
  }
}

TEST(RenderLight, DrawsDarkDiscsOnABrightGround) {
  Cell cell = test_cell();
  cell.light.target_level = 0.1;
  cell.light.retro_falloff_deg = 0;
  cell.light.background_level = 0.6;
  const FrameTruth truth = truth_of(stage_of(cell), 0.2);
  const Raster<float> light = render_light(stage_of(cell), Side::Left, 0.2, 1, 0);
  for (const TargetTruth& target : truth.targets) {
    if (target.side != Side::Left) continue;
    const Spot spot = spot_around(light, target.image.centre, 14, 0.6);
    EXPECT_NEAR(spot.sum, -0.5 * std::numbers::pi * target.image.semi_major * target.image.semi_minor, 2e-3);
    EXPECT_LT((spot.centroid - target.image.centre).norm(), 1e-3);
  }
}

TEST(RenderLight, BlursAMovingDiscAlongItsWayAndKeepsItsMiddle) {
  Cell cell = test_cell();
  cell.sensor.exposure_s = 0.02;
  const FrameTruth truth = truth_of(stage_of(cell), 0.3);
  const Raster<float> light = render_light(stage_of(cell), Side::Left, 0.3, 1, 0);
  cell.sensor.exposure_s = 0;
  const Raster<float> sharp = render_light(stage_of(cell), Side::Left, 0.3, 1, 0);
  for (std::size_t i = 0; i < truth.targets.size(); ++i) {
    const TargetTruth& target = truth.targets[i];
    if (target.side != Side::Left) continue;
    ASSERT_GT(target.blur_px, 0.5);
    Vec2 mean = Vec2::Zero();  // over the exposure, each instant by its light
    double weight = 0;
    for (int k = 0; k < 20; ++k) {
      const Ellipse image = truth_of(stage_of(cell), 0.3 + 0.02 * ((k + 0.5) / 20 - 0.5)).targets[i].image;
      mean += image.semi_major * image.semi_minor * image.centre;
      weight += image.semi_major * image.semi_minor;
    }
    mean /= weight;
    const Spot spot = spot_around(light, target.image.centre, 24, cell.light.background_level);
    const Spot still = spot_around(sharp, target.image.centre, 24, cell.light.background_level);
    EXPECT_LT((spot.centroid - mean).norm(), 1e-3);
    EXPECT_NEAR(spot.sum / still.sum, 1, 1e-3);
    const int x = static_cast<int>(std::lround(target.image.centre.x()));
    const int y = static_cast<int>(std::lround(target.image.centre.y() + target.image.semi_major));
    EXPECT_GT(std::abs(light.at(x, y) - sharp.at(x, y)), 1e-3);  // its edge is softer
  }
}

TEST(RenderLight, CutsOutWhatAnObstacleHides) {
  Cell cell = test_cell();
  cell.sensor.exposure_s = 0;
  // A rod that stands over the platform, between it and the cameras.
  const Vec3 along = pose_at(cell.movers[0].motion, 0.3) * Vec3(-200, 100, 600);
  cell.obstacles.push_back(
      {"rod", Capsule{0.6 * along + Vec3(0, -300, 0), 0.6 * along + Vec3(0, 300, 0), 2}, "", {}, {}});
  const FrameTruth truth = truth_of(stage_of(cell), 0.3);
  const Raster<float> light = render_light(stage_of(cell), Side::Left, 0.3, 1, 0);
  int partly = 0;
  for (const TargetTruth& target : truth.targets) {
    if (target.side != Side::Left) continue;
    const double whole = (cell.light.target_level * target.brightness - cell.light.background_level) *
                         std::numbers::pi * target.image.semi_major * target.image.semi_minor;
    const Spot spot = spot_around(light, target.image.centre, 14, cell.light.background_level);
    EXPECT_NEAR(spot.sum / whole, target.visible, 0.01);
    partly += target.visible > 0.05 && target.visible < 0.95 ? 1 : 0;
  }
  EXPECT_GE(partly, 1);
}

TEST(RenderLight, PaintsAnObstacleWithItsOwnLevelAndASoftEdge) {
  Cell cell = test_cell();
  cell.movers[0].body.targets.resize(1);
  const Box box{{400, 300, 10}};
  cell.obstacles.push_back({"plate", box, "", {Quaternion::Identity(), {0, 0, 1600}}, 0.2});
  const Raster<float> light = render_light(stage_of(cell), Side::Left, 0, 1, 0);
  const double near_z = 1595;  // the face towards the camera is the outline
  const double edge = 511.5 + 1600 * 200 / near_z;
  EXPECT_NEAR(light.at(511, 383), 0.2, 1e-6);
  EXPECT_NEAR(light.at(static_cast<int>(edge) + 8, 383), cell.light.background_level, 1e-6);
  double covered = 0;
  for (int x = 600; x < 800; ++x) covered += (light.at(x, 383) - 0.03) / 0.17;
  EXPECT_NEAR(599.5 + covered, edge, 1e-3);
}

TEST(RenderLight, TiltsTheBackgroundAndDarkensTheCorners) {
  Cell cell = test_cell();
  cell.movers[0].motion = at_rest({Quaternion::Identity(), {0, 0, -2000}});
  cell.light.background_level = 0.2;
  cell.light.gradient_x = 0.5;
  Raster<float> light = render_light(stage_of(cell), Side::Left, 0, 1, 0);
  EXPECT_NEAR(light.at(0, 300), 0.2 * 0.75, 1e-4);
  EXPECT_NEAR(light.at(1023, 300), 0.2 * 1.25, 1e-4);
  cell.light.gradient_x = 0;
  cell.light.vignetting = 0.4;
  light = render_light(stage_of(cell), Side::Left, 0, 1, 0);
  EXPECT_NEAR(light.at(0, 0), 0.2 * 0.6, 1e-6);
  EXPECT_NEAR(light.at(512, 384), 0.2, 1e-4);
}

TEST(RenderLight, PutsInAboutAsManyGlintsAsAsked) {
  Cell cell = test_cell();
  cell.movers[0].motion = at_rest({Quaternion::Identity(), {0, 0, -2000}});
  cell.light.glints = 12;
  const Raster<float> light = render_light(stage_of(cell), Side::Left, 0, 1, 0);
  std::set<int> lit;  // tiles of 64 × 64 px; a glint may reach into a neighbour
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      if (light.at(x, y) > 0.1F) lit.insert(y / 64 * 100 + x / 64);
    }
  }
  EXPECT_GE(lit.size(), 5U);
  EXPECT_LE(lit.size(), 25U);
}

}  // namespace
}  // namespace asterism
