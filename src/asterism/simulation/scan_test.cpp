// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/simulation/test_cell.hpp"

namespace asterism {
namespace {

/// A wall 1 m wide on the platform, its face in z = 0 of the platform's frame; the scanner square on before
/// it, 300 mm away, with x and y along the wall's.
Cell wall_cell() {
  Cell cell = test_cell();
  const RigidMotion platform = pose_at(cell.movers[0].motion, 0);
  cell.movers[0].motion = at_rest(platform);
  cell.workpiece = Solid{
      "wall", std::make_shared<TriangleMesh>(mesh_of(Box{{1000, 1000, 20}})), "platform", {}, std::nullopt};
  cell.workpiece->carrier_from_solid.translation.z() = -10;
  Body body = cell.movers[0].body;
  body.name = "scanner";
  const RigidMotion platform_from_scanner{exp_rotation(Vec3(std::numbers::pi, 0, 0)), Vec3(0, 0, 300)};
  cell.movers.push_back({body, at_rest(platform * platform_from_scanner)});
  cell.scanner = Scanner{};
  cell.scanner->outlier_share = 0;
  cell.scanner->place_sigma_mm = cell.scanner->place_sigma_deg = 0;
  return cell;
}

Scanner& without_noise(Cell& cell) {
  cell.scanner->depth_sigma_mm = cell.scanner->lateral_sigma_mm = 0;
  return *cell.scanner;
}

/// Tilted about the scanner's y (along the lines) or x axis, or moved along z.
void place_scanner(Cell& cell, double distance_mm, const Vec3& tilt_rad) {
  const RigidMotion platform = pose_at(cell.movers[0].motion, 0);
  const RigidMotion platform_from_scanner{exp_rotation(Vec3(std::numbers::pi, 0, 0)) * exp_rotation(tilt_rad),
                                          Vec3(0, 0, distance_mm)};
  cell.movers[1].motion = at_rest(platform * platform_from_scanner);
}

const ScanPass kOneSweep{1, 0, 0.5};

TEST(SimulateScan, APlaneWallLiesWhereItIsAndTheFieldIsFilled) {
  Cell cell = wall_cell();
  without_noise(cell);
  const SimulatedScan made = simulate_scan(stage_of(cell), kOneSweep, 1);
  Vec3f low = Vec3f::Constant(1e9F), high = -low;
  for (const Vec3f& point : made.scan.in_scanner) {
    EXPECT_NEAR(point.z(), 300, 1e-4);  // single precision at 300 mm is 3e-5
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  EXPECT_NEAR(high.x() - low.x(), 350, 2 * 2.5);
  EXPECT_NEAR(high.y() - low.y(), 310, 2 * 2.5);
  EXPECT_NEAR(static_cast<double>(made.scan.in_scanner.size()), 140 * 124, 2 * 124)
      << "one line to either side";
  ASSERT_EQ(made.true_in_workpiece.size(), made.scan.in_scanner.size());
  for (const Vec3f& truth : made.true_in_workpiece) EXPECT_NEAR(truth.z(), 10, 1e-4);
}

TEST(SimulateScan, FillsTheFieldAtEveryDepth) {
  for (const double z : {205.0, 395.0}) {
    Cell cell = wall_cell();
    without_noise(cell);
    place_scanner(cell, z, Vec3::Zero());
    const SimulatedScan made = simulate_scan(stage_of(cell), kOneSweep, 1);
    float low = 0, high = 0;
    for (const Vec3f& point : made.scan.in_scanner) {
      low = std::min(low, point.x());
      high = std::max(high, point.x());
    }
    const double half = 175 * z / 300, step = 2.5 * z / 300;
    EXPECT_NEAR(low, -half, 1.01 * step);
    EXPECT_NEAR(high, half, 1.01 * step);
  }
}

TEST(SimulateScan, NothingIsMeasuredBeyondRange) {
  for (const double z : {190.0, 410.0}) {
    Cell cell = wall_cell();
    place_scanner(cell, z, Vec3::Zero());
    const SimulatedScan made = simulate_scan(stage_of(cell), kOneSweep, 1);
    EXPECT_TRUE(made.scan.in_scanner.empty());
    EXPECT_EQ(made.beyond_range > 0, z < 200) << "light is followed no farther than the range";
  }
}

TEST(SimulateScan, NoiseAgreesWithRangeNoise) {
  Cell cell = wall_cell();
  place_scanner(cell, 300, Vec3(0, rad_from_deg(25), 0));
  cell.scanner->lateral_sigma_mm = 0.05;
  const Stage stage = stage_of(cell);
  const SimulatedScan made = simulate_scan(stage, kOneSweep, 3);
  const RigidMotion scanner_from_workpiece =
      (poses_at(cell, 0)[1]).inverse() * poses_at(cell, 0)[0] * cell.workpiece->carrier_from_solid;
  const Vec3 normal = scanner_from_workpiece.rotation * Vec3::UnitZ();
  Vec3 chi2 = Vec3::Zero();
  for (std::size_t i = 0; i < made.scan.in_scanner.size(); ++i) {
    const Vec3 truth = scanner_from_workpiece * made.true_in_workpiece[i].cast<double>();
    const RangeNoise noise = range_noise(*cell.scanner, truth.z(), std::abs(normal.dot(truth.normalized())));
    const Vec3 off = made.scan.in_scanner[i].cast<double>() - truth;
    chi2 += off.cwiseQuotient(Vec3(noise.lateral_mm, noise.lateral_mm, noise.depth_mm)).cwiseAbs2();
  }
  const auto n = static_cast<double>(made.scan.in_scanner.size());
  ASSERT_GT(n, 5000);
  for (const double each : chi2) EXPECT_NEAR(each / n, 1, 4 * std::sqrt(2 / n));  // 4σ of χ²/n
}

TEST(SimulateScan, OutliersLieAlongTheLineOfSightAndAreTold) {
  Cell cell = wall_cell();
  without_noise(cell).outlier_share = 0.05;
  const SimulatedScan made = simulate_scan(stage_of(cell), kOneSweep, 1);
  std::size_t outliers = 0;
  for (std::size_t i = 0; i < made.scan.in_scanner.size(); ++i) {
    const Vec3f& point = made.scan.in_scanner[i];
    const double off = std::abs(point.z() - 300) * point.norm() / point.z();
    EXPECT_LE(off, 8.001);
    outliers += made.outlier[i];
    EXPECT_TRUE(made.outlier[i] == 1 || off < 1e-3) << off;
  }
  const auto n = static_cast<double>(made.scan.in_scanner.size());
  EXPECT_NEAR(static_cast<double>(outliers) / n, 0.05, 4 * std::sqrt(0.05 * 0.95 / n));
}

TEST(SimulateScan, GrazingPlacesAreLostMoreAndMoreAndNoneIsMeasuredBeyondTheLimit) {
  Cell cell = wall_cell();
  without_noise(cell);
  place_scanner(cell, 300 * std::cos(rad_from_deg(50)), Vec3(rad_from_deg(50), 0, 0));
  const SimulatedScan made = simulate_scan(stage_of(cell), kOneSweep, 1);
  const Vec3 normal =
      (poses_at(cell, 0)[1].rotation.conjugate() * poses_at(cell, 0)[0].rotation) * Vec3::UnitZ();
  std::size_t well = 0, badly = 0;
  for (const Vec3f& point : made.scan.in_scanner) {
    const double incidence = deg_from_rad(std::acos(std::abs(normal.dot(point.cast<double>().normalized()))));
    ASSERT_LE(incidence, 60.01);
    well += incidence > 40 && incidence < 45 ? 1 : 0;
    badly += incidence > 55 ? 1 : 0;
  }
  EXPECT_GT(well, 10 * badly / 5);
  EXPECT_GT(badly, 0U);
  EXPECT_GT(made.grazing, badly);
}

TEST(SimulateScan, APostKeepsLightAndSightFromTwoStripes) {
  Cell cell = wall_cell();
  without_noise(cell);
  const std::size_t free = simulate_scan(stage_of(cell), kOneSweep, 1).scan.in_scanner.size();
  // A post 10 mm wide, 150 mm before the wall: from projector and camera, 80 mm to either side, it hides
  // 20 mm each, about x = +80 and x = −80 of the wall.
  Obstacle post{"post", Box{{10, 2000, 0.2}}, "platform", {}, std::nullopt};
  post.carrier_from_shape.translation.z() = 150;
  const auto check = [&](const Cell& with) {
    const SimulatedScan made = simulate_scan(stage_of(with), kOneSweep, 1);
    for (const Vec3f& point : made.scan.in_scanner) {
      EXPECT_NEAR(point.z(), 300, 1e-3) << "the post itself gives no points";
      EXPECT_GT(std::abs(std::abs(point.x()) - 80), 9);
    }
    EXPECT_NEAR(static_cast<double>(free - made.scan.in_scanner.size()), 2 * 8 * 124, 3 * 124);
    EXPECT_EQ(made.shadowed, free - made.scan.in_scanner.size());
  };
  Cell by_shape = cell, by_mesh = cell, by_part = cell;
  by_shape.obstacles.push_back(post);
  check(by_shape);
  by_mesh.fixtures.push_back(Solid{"post", std::make_shared<TriangleMesh>(mesh_of(post.shape)), "platform",
                                   post.carrier_from_shape, std::nullopt});
  check(by_mesh);
  post.body = "scanner";
  by_part.obstacles.push_back(post);
  EXPECT_EQ(simulate_scan(stage_of(by_part), kOneSweep, 1).scan.in_scanner.size(), free)
      << "what the scanner carries does not stand in its way";
}

TEST(SimulateScan, ThePartHidesItselfFromTheCamera) {
  Cell cell = wall_cell();
  without_noise(cell);
  TriangleMesh part = *cell.workpiece->surface;
  append(part, moved(mesh_of(Box{{40, 1000, 60}}), {Quaternion::Identity(), Vec3(0, 0, 39.9)}));
  cell.workpiece->surface = std::make_shared<TriangleMesh>(part);
  const SimulatedScan made = simulate_scan(stage_of(cell), kOneSweep, 1);
  // The rib's top is 59.9 mm above the wall: beside it 20 + 60 (80 + 20)/240 = 45 mm are hidden at the most.
  for (const Vec3f& point : made.scan.in_scanner) {
    EXPECT_TRUE(point.z() < 299 || std::abs(point.x()) > 44) << point;
  }
  EXPECT_GT(made.shadowed, 0U);
}

TEST(SimulateScan, PointsCarriedByTheMotionOfTheirMomentLieWhereTheLightFell) {
  Cell cell = wall_cell();
  without_noise(cell);
  Sweep sweep;
  sweep.tracker_from_rest = pose_at(cell.movers[0].motion, 0);
  sweep.yaw = {rad_from_deg(10), 0.4, 0.3};
  sweep.pitch = {rad_from_deg(8), 0.3, 0};
  sweep.z = {20, 0.5, 0};
  cell.movers[0].motion = sweep;
  cell.scanner->body_from_scanner = {exp_rotation(Vec3(0.1, 0.2, 0.3)), Vec3(1, 2, 3)};
  cell.scanner->place_sigma_mm = 0.5;
  cell.scanner->place_sigma_deg = 0.1;
  const std::uint64_t seed = 5;
  const SimulatedScan made = simulate_scan(stage_of(cell), {1, 0.2, 1.4}, seed);
  ASSERT_GT(made.scan.in_scanner.size(), 10000U);
  const RigidMotion body_from_scanner = true_body_from_scanner(*cell.scanner, seed);
  double farthest = 0;
  for (std::size_t i = 0; i < made.scan.in_scanner.size(); i += 50) {
    const auto poses = poses_at(cell, made.scan.times_s[i]);
    const RigidMotion workpiece_from_scanner =
        (poses[0] * cell.workpiece->carrier_from_solid).inverse() * poses[1] * body_from_scanner;
    const Vec3 carried = workpiece_from_scanner * made.scan.in_scanner[i].cast<double>();
    farthest = std::max(farthest, (carried - made.true_in_workpiece[i].cast<double>()).norm());
    EXPECT_NEAR(carried.z(), 10, 1e-3);
  }
  EXPECT_LT(farthest, 1e-3);  // single precision of both
}

TEST(SimulateScan, SweepsFollowOneAnotherWhileThePassLasts) {
  Cell cell = wall_cell();
  without_noise(cell);
  const Stage stage = stage_of(cell);
  const Scan one = simulate_scan(stage, {1, 2, 2.5}, 1).scan;
  const Scan three = simulate_scan(stage, {1, 2, 3.502}, 1).scan;
  EXPECT_EQ(one.time_s, 2);
  EXPECT_GE(one.times_s.front(), 2);
  EXPECT_LE(one.times_s.back(), 2.5 + 1e-9);
  EXPECT_TRUE(std::is_sorted(three.times_s.begin(), three.times_s.end()));
  EXPECT_EQ(three.in_scanner.size(), 3 * one.in_scanner.size());
  cell.scanner->sweep_s = 0;
  const Scan at_once = simulate_scan(stage_of(cell), {1, 2, 3}, 1).scan;
  EXPECT_EQ(at_once.in_scanner.size(), one.in_scanner.size());
  EXPECT_EQ(at_once.times_s.back(), 2);
}

TEST(SimulateScan, TheScannersPlaceIsDrawnOnceASeed) {
  Scanner scanner;
  scanner.place_sigma_mm = 0.3;
  scanner.place_sigma_deg = 0.2;
  Vec6 squares = Vec6::Zero();
  constexpr int kDraws = 2000;
  for (int seed = 0; seed < kDraws; ++seed) {
    const auto draw = static_cast<std::uint64_t>(seed);
    const Vec6 error = difference(true_body_from_scanner(scanner, draw), scanner.body_from_scanner);
    squares += error.cwiseAbs2();
  }
  for (int axis = 0; axis < 3; ++axis) {  // 4σ of a variance from 2000 draws: 13 %
    EXPECT_NEAR(std::sqrt(squares(axis) / kDraws), rad_from_deg(0.2), 0.065 * rad_from_deg(0.2));
    EXPECT_NEAR(std::sqrt(squares(axis + 3) / kDraws), 0.3, 0.065 * 0.3);
  }
}

TEST(SimulateScan, GivesTheSamePointsOnAnyNumberOfThreads) {
  const Stage stage = stage_of(wall_cell());
  set_thread_count(1);
  const SimulatedScan one = simulate_scan(stage, kOneSweep, 9);
  set_thread_count(4);
  const SimulatedScan four = simulate_scan(stage, kOneSweep, 9);
  set_thread_count(0);
  EXPECT_EQ(one.scan.in_scanner, four.scan.in_scanner);
  EXPECT_EQ(one.true_in_workpiece, four.true_in_workpiece);
  EXPECT_NE(one.scan.in_scanner, simulate_scan(stage, kOneSweep, 10).scan.in_scanner);
  EXPECT_NE(one.scan.in_scanner, simulate_scan(stage, {2, 0, 0.5}, 9).scan.in_scanner);
}

TEST(SimulateScan, TellsWhatIsMissing) {
  Cell cell = wall_cell();
  cell.workpiece.reset();
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(simulate_scan(stage_of(cell), kOneSweep, 1)); }),
               "has no [workpiece]");
  cell = wall_cell();
  cell.scanner.reset();
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(simulate_scan(stage_of(cell), kOneSweep, 1)); }),
               "has no [scanner]");
}

}  // namespace
}  // namespace asterism
