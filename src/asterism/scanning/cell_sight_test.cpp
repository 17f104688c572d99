// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/cell_sight.hpp"

#include <gtest/gtest.h>

#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/scanning/scan_cell_for_tests.hpp"

namespace asterism {
namespace {

const SurfaceSample kOutside{{200, 0, 100}, Vec3::UnitX(), 0, 1, 1};

/// Square on at a place of the outer wall, the azimuth from the part's x axis.
RigidMotion view_from(double azimuth_deg) {
  const double a = rad_from_deg(azimuth_deg);
  const Vec3 out(std::cos(a), std::sin(a), 0);
  return looking_at(200 * out + Vec3(0, 0, 100), out, 300, 0);
}

Sighting look(const Cell& cell, const RigidMotion& view, int targets = 4) {
  return CellSight(cell, platform_poses(cell, 1), targets).look(0, std::span(&view, 1)).front();
}

TEST(PlatformPoses, BeginAtRestAndKeepToTheStroke) {
  Cell cell = scene::scan_cell();
  cell.platform->stroke.roll_deg = 0;
  const auto poses = platform_poses(cell, 3);
  ASSERT_EQ(poses.size(), 9U);
  EXPECT_EQ(poses[0].yaw_deg, 0);
  EXPECT_EQ(poses[0].pitch_deg, 0);
  EXPECT_NEAR(
      rotation_angle(poses[0].tracker_from_platform.rotation, poses[8].tracker_from_platform.rotation),
      rad_from_deg(21.1), rad_from_deg(0.2));  // 15 degrees about each of two axes
  for (const PlatformPose& pose : poses) EXPECT_EQ(pose.roll_deg, 0);
}

TEST(CellSight, SeesScannerAndPlatformInTheOpen) {
  const Sighting sighting = look(scene::scan_cell(), view_from(45));
  EXPECT_EQ(sighting.fails, 0U);
  EXPECT_GE(sighting.scanner_targets, 4);
  EXPECT_EQ(sighting.platform_targets, 7);
  EXPECT_TRUE(sighting.covariance.has_value());
}

TEST(CellSight, NamesWhoseTargetsAreMissing) {
  EXPECT_EQ(look(scene::scan_cell(), view_from(45), 8).fails,
            mask_of(ScanLimit::PlatformTargets) | mask_of(ScanLimit::ScannerTargets));
  Cell cell = scene::scan_cell();
  cell.movers[1].body.targets.resize(3);
  EXPECT_EQ(look(cell, view_from(45)).fails, mask_of(ScanLimit::ScannerTargets));
}

TEST(CellSight, SeesNoTargetsBehindAWall) {
  Cell cell = scene::scan_cell();
  Obstacle wall;
  wall.name = "wall";
  wall.shape = Box{{4000, 4000, 10}};
  wall.carrier_from_shape.translation = {0, 0, 1000};  // before the cameras
  cell.obstacles = {wall};
  const Sighting sighting = look(cell, view_from(45));
  EXPECT_EQ(sighting.scanner_targets, 0);
  EXPECT_EQ(sighting.platform_targets, 0);
}

TEST(CellSight, KeepsTheScannerOffTheFloorAndWhatStandsAround) {
  Cell cell = scene::scan_cell();
  cell.scan_task.floor_mm = -20;  // the view stands at 100 mm, its ball has 110 mm
  EXPECT_EQ(look(cell, view_from(45)).fails, 0U);
  cell.scan_task.floor_mm = -5;
  EXPECT_EQ(look(cell, view_from(45)).fails, mask_of(ScanLimit::Floor));
  cell.scan_task.floor_mm.reset();
  Obstacle post;
  post.name = "post";
  post.shape = Capsule{{0, 0, 0}, {0, 0, 1}, 20};
  const RigidMotion rest = platform_poses(cell, 1)[0].tracker_from_platform;
  post.carrier_from_shape.translation = rest * (view_from(225).translation + Vec3(0, 0, 120));
  cell.obstacles = {post};
  EXPECT_NE(look(cell, view_from(225)).fails & mask_of(ScanLimit::Clearance), 0U);
}

TEST(CellSight, TellsTheWholeChainsCovarianceHonestly) {
  const Cell cell = scene::scan_cell();
  const CellSight sight(cell, platform_poses(cell, 1), 4);
  const RigidMotion view = view_from(45), part = sight.tracker_from_part(0);
  const RigidMotion body = sight.tracker_from_body(0, view);
  const Sighting sighting = sight.look(0, std::span(&view, 1)).front();
  ASSERT_TRUE(sighting.covariance);
  AccuracyOptions options;
  options.sigma_px = cell.noise.sigma_px;
  options.map_sigma_mm = cell.noise.map_sigma_mm;
  const auto covariance = [&](std::size_t mover, const RigidMotion& pose) {
    const auto& targets = cell.movers[mover].body.targets;
    auto seen = visible_targets(targets, std::span(&pose, 1), cell.rig, cell.volume, {}).seen[0];
    std::vector<RigidMotion> movers = {part, body};
    const Occlusion occlusion(cell);
    seen = occlusion.unhidden_of({{seen}}, targets, mover, std::span(&movers, 1)).seen[0];
    return predict_pose_accuracy(targets, seen, pose, cell.rig, options)->covariance;
  };
  const MatX of_part = symmetric_root(covariance(0, part)), of_body = symmetric_root(covariance(1, body));
  const Scanner& scanner = *cell.scanner;
  double square = 0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(1, static_cast<std::uint64_t>(i));
    const auto draw = [&] {
      Vec6 vector;
      for (int k = 0; k < 6; ++k) vector(k) = random.normal();
      return vector;
    };
    Vec6 place = draw();
    place.head<3>() *= rad_from_deg(scanner.place_sigma_deg);
    place.tail<3>() *= scanner.place_sigma_mm;
    const RigidMotion chain = perturbed(part, of_part * draw()).inverse() *
                              perturbed(body, of_body * draw()) * perturbed(scanner.body_from_scanner, place);
    const Vec3 in_scanner = view.inverse() * kOutside.at;
    const double depth = in_scanner.z();
    const double cosine = kOutside.normal.dot((view.translation - kOutside.at).normalized());
    const RangeNoise noise = range_noise(scanner, depth, cosine);
    const Vec3 off(noise.lateral_mm * random.normal(), noise.lateral_mm * random.normal(),
                   noise.depth_mm * random.normal());
    const double error = kOutside.normal.dot(chain * (in_scanner + off) - kOutside.at);
    square += error * error / kDraws;
  }
  const double predicted = sigma_along_normal_mm(scanner, view, *sighting.covariance, kOutside);
  // The variance of 4000 draws is known to 2.2 %; four of that are 9 %.
  EXPECT_NEAR(square / (predicted * predicted), 1, 0.09);
}

TEST(CellSight, RefusesACellWithoutScannerOrPart) {
  Cell cell = scene::scan_cell();
  cell.scanner.reset();
  EXPECT_THROW(static_cast<void>(CellSight(cell, platform_poses(cell, 1), 4)), InputError);
  cell = scene::scan_cell();
  cell.workpiece.reset();
  EXPECT_THROW(static_cast<void>(CellSight(cell, platform_poses(cell, 1), 4)), InputError);
}

}  // namespace
}  // namespace asterism
