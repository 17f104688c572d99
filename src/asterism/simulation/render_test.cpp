// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/render.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "asterism/camera/disc_image.hpp"
#include "asterism/cell/occluders.hpp"
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
  EXPECT_NEAR(light.at(511, 383), 0.2, 1e-5);
  EXPECT_NEAR(light.at(static_cast<int>(edge) + 8, 383), cell.light.background_level, 1e-6);
  // Where the light falls through the middle between both sides: four samples a pixel place it to 1/8 px, and
  // a straight line between two pixels is off by up to 0.07 px.
  const double middle = 0.5 * (light.at(static_cast<int>(edge) - 8, 383) + cell.light.background_level);
  int x = static_cast<int>(edge) - 8;
  while (light.at(x + 1, 383) > middle) ++x;
  EXPECT_NEAR(x + (light.at(x, 383) - middle) / (light.at(x, 383) - light.at(x + 1, 383)), edge, 0.2);
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

/// One disc of 6 mm radius that faces the left camera squarely, and how it moves.
Cell disc_cell(const Motion& motion) {
  Cell cell;
  cell.name = "disc";
  cell.rig = rig_of({1024, 768, 1600, 1000, 2300});
  cell.movers.push_back({{"plate", {{"T", {0, 0, 0}, Vec3(0, 0, -1), 12.0, {}}}}, motion});
  cell.sensor.exposure_s = 0;
  return cell;
}
RigidMotion place(double x, double y, double z) { return {Quaternion::Identity(), {x, y, z}}; }

Raster<float> left_light(const Cell& cell, double time_s = 0) {
  return render_light(stage_of(cell), Side::Left, time_s, 1, 0);
}

TEST(RenderLight, BlursADiscOutOfFocusByItsCircleOfConfusion) {
  for (const double depth_mm : {1500.0, 2000.0, 2600.0}) {
    Cell cell = disc_cell(at_rest(place(0, 0, depth_mm)));
    cell.sensor.focus_mm = 2000;
    cell.sensor.aperture_mm = 20;
    const Raster<float> light = left_light(cell);
    const Spot spot = spot_around(light, {511.5, 383.5}, 60, cell.light.background_level);
    double spread = 0;
    for (int y = 323; y < 444; ++y) {
      for (int x = 451; x < 572; ++x)
        spread += (light.at(x, y) - cell.light.background_level) * (x - 511.5) * (x - 511.5);
    }
    const double radius_px = 1600 * 6 / depth_mm;
    const double confusion_px = 1600.0 * 20 * std::abs(depth_mm - 2000) / (depth_mm * 2000);
    // Of an even disc r² / 4 along an axis, of a pixel 1 / 12.
    const double told = 0.55 * 0.55 + confusion_px * confusion_px / 16 + radius_px * radius_px / 4 + 1.0 / 12;
    EXPECT_NEAR(spread / spot.sum / told, 1, 1e-3);
    const double level = cell.light.target_level - cell.light.background_level;
    EXPECT_NEAR(spot.sum / (level * std::numbers::pi * radius_px * radius_px), 1, 1e-3);
  }
}

TEST(RenderLight, DrawsAStreakOfFortyPixelsAroundTheMiddleOfTheExposure) {
  // 5 m/s sideways at 2 m: 40 px in 10 ms.
  Cell cell = disc_cell(
      KeyedMotion{{{-1, place(-5000, 0, 2000)}, {0, place(0, 0, 2000)}, {1, place(5000, 0, 2000)}}});
  cell.sensor.exposure_s = 0.01;
  const Raster<float> light = left_light(cell);
  const Spot spot = spot_around(light, {511.5, 383.5}, 40, cell.light.background_level);
  EXPECT_LT((spot.centroid - Vec2(511.5, 383.5)).norm(), 0.01);
  const double area = std::numbers::pi * 4.8 * 4.8;
  EXPECT_NEAR(spot.sum / (area * (cell.light.target_level - cell.light.background_level)), 1, 2e-3);
  double spread = 0;
  for (int y = 350; y < 417; ++y) {
    for (int x = 471; x < 552; ++x)
      spread += (light.at(x, y) - cell.light.background_level) * (x - 511.5) * (x - 511.5);
  }
  EXPECT_NEAR(spread / spot.sum, 40.0 * 40 / 12 + 4.8 * 4.8 / 4 + 0.55 * 0.55 + 1.0 / 12, 1);
  // No steps: along the middle of the streak the light is even.
  for (int x = 498; x < 525; ++x) EXPECT_NEAR(light.at(x, 383), light.at(511, 383), 1e-3) << x;
}

TEST(RenderLight, FollowsAFastTurnAlongItsArc) {
  // Half a turn a second about an axis 600 mm away.
  KeyedMotion turn;
  for (int i = -3; i <= 3; ++i)
    turn.keys.push_back({0.1 * i, {exp_rotation({0, 0, 0.1 * i * std::numbers::pi}), {0, 0, 2000}}});
  Cell cell = disc_cell(turn);
  cell.movers[0].body.targets[0].position = {400, 0, 0};
  cell.sensor.exposure_s = 0.02;  // 25 mm, 20 px
  const Raster<float> light = left_light(cell);
  Vec2 mean = Vec2::Zero();
  constexpr int kTimes = 501;
  for (int i = 0; i < kTimes; ++i) {
    const double angle = 0.02 * std::numbers::pi * ((i + 0.5) / kTimes - 0.5);
    mean += (Vec2(511.5, 383.5) + 320 * Vec2(std::cos(angle), std::sin(angle))) / kTimes;
  }
  const Spot spot = spot_around(light, mean, 30, cell.light.background_level);
  EXPECT_LT((spot.centroid - mean).norm(), 0.01);
}

TEST(RenderLight, CutsADiscByAMeshAsByTheSameBox) {
  Cell cell = disc_cell(at_rest(place(0, 0, 2000)));
  for (int i = 0; i < 6; ++i) {
    const RigidMotion at = {exp_rotation({0.1, 0.05 * i, 0.2 * i}), {-22 + 1.1 * i, 0, 1000}};
    const Box box{{40, 60, 10}};
    cell.fixtures.clear();
    cell.obstacles = {{"box", box, "", at, {}}};
    const Raster<float> by_box = left_light(cell);
    cell.obstacles.clear();
    cell.fixtures = {{"box", std::make_shared<const TriangleMesh>(mesh_of(box)), "", at, {}}};
    const Raster<float> by_mesh = left_light(cell);
    double largest = 0;
    for (std::size_t k = 0; k < by_box.pixels.size(); ++k)
      largest = std::max<double>(largest, std::abs(by_box.pixels[k] - by_mesh.pixels[k]));
    // Single precision moves the edge by 0.0002 mm: a few cells of 1/64 px that lie just on it, at most.
    EXPECT_LT(largest, 3.0 / 64 * cell.light.target_level) << i;
  }
}

TEST(RenderLight, TakesHalfTheLightOfATargetThatFallsInTheMiddleOfTheExposure) {
  Cell cell =
      disc_cell(KeyedMotion{{{-1, place(-500, 0, 2000)}, {0, place(0, 0, 2000)}, {1, place(500, 0, 2000)}}});
  cell.sensor.exposure_s = 0.01;
  const auto sum = [&] {
    return spot_around(left_light(cell), {511.5, 383.5}, 30, cell.light.background_level).sum;
  };
  const double whole = sum();
  cell.faults = {{FaultKind::FallsOff, "plate", "T", 1e-6, {}}};
  EXPECT_NEAR(sum() / whole, 0.5, 0.05);  // one of some twenty instants
  cell.faults[0].time_s = -0.1;
  EXPECT_NEAR(sum() / whole, 0, 1e-6);
}

TEST(RenderLight, ShowsALampWithItsHaloUnlessSomethingStandsBeforeIt) {
  Cell cell = disc_cell(at_rest(place(0, 0, -2000)));
  cell.lamps = {{"lamp", {0, 0, 2000}, 20, 2.5, 0.1, 30}};
  const double background = cell.light.background_level;
  const Raster<float> light = left_light(cell);
  EXPECT_NEAR(light.at(511, 383), 2.5 + 0.1, 1e-3);
  for (const double beyond_px : {20.0, 50.0}) {
    const double at = 511.5 + 16 + beyond_px;  // the lamp's image has a radius of 16 px
    const double told = 0.5 * (light.at(static_cast<int>(at), 383) + light.at(static_cast<int>(at) + 1, 383));
    EXPECT_NEAR(told - background, 0.1 * std::exp(-beyond_px / 30), 1e-3);
  }
  cell.obstacles = {{"shutter", Box{{100, 100, 1}}, "", place(0, 0, 1500), {}}};
  EXPECT_NEAR(left_light(cell).at(511, 383), background, 1e-6);
}

TEST(RenderLight, LightsASurfaceByLambertsLawAndMirrorsTheLampWhereItFacesIt) {
  Cell cell = disc_cell(at_rest(place(0, 0, -2000)));
  const auto plate = std::make_shared<const TriangleMesh>(mesh_of(Box{{300, 300, 10}}));
  for (const double tilt_deg : {0.0, 4.0, 40.0}) {
    cell.light.specular = 0.8;
    cell.fixtures = {{"plate", plate, "", {exp_rotation({0, rad_from_deg(tilt_deg), 0}), {0, 0, 2000}}, 0.3}};
    const double cosine = std::cos(rad_from_deg(tilt_deg));
    // The pixel is half a pixel off the axis, 3e-4 rad: at 4° the highlight changes by 7.6 a radian.
    EXPECT_NEAR(left_light(cell).at(511, 383), 0.3 * cosine + 0.8 * std::pow(cosine, 256), 4e-3) << tilt_deg;
  }
}

TEST(RenderLight, ShowsTheNearerOfTwoSurfaces) {
  Cell cell = disc_cell(at_rest(place(0, 0, -2000)));
  const auto plate = std::make_shared<const TriangleMesh>(mesh_of(Box{{300, 300, 10}}));
  cell.fixtures = {{"near", plate, "", place(0, 0, 1500), 0.1}, {"far", plate, "", place(0, 0, 2000), 0.7}};
  EXPECT_NEAR(left_light(cell).at(511, 383), 0.1, 1e-3);
  std::swap(cell.fixtures[0], cell.fixtures[1]);
  EXPECT_NEAR(left_light(cell).at(511, 383), 0.1, 1e-3);
}

}  // namespace
}  // namespace asterism
