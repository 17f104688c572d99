// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/scan_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/random.hpp"
#include "asterism/scanning/scan_surface.hpp"
#include "asterism/simulation/scan.hpp"
#include "asterism/simulation/test_cell.hpp"
#include "asterism/statistics/intervals.hpp"

namespace asterism {
namespace {

FusedPoint fused(const Vec3& at, double sigma_mm) {
  FusedPoint point;
  point.at = at;
  point.covariance = sigma_mm * sigma_mm * Mat3::Identity();
  return point;
}

TEST(CloudErrors, AreThoseAlongTheNormal) {
  const SurfaceTree surface(mesh_of(Box{{100, 100, 100}}));
  const std::vector<FusedPoint> cloud = {fused({10, 20, 50.3}, 0.1), fused({-10, 5, 49.9}, 0.1),
                                         fused({0, 0, 80}, 0.1)};
  const CloudErrors errors = cloud_errors(cloud, surface, 5);
  EXPECT_EQ(errors.points, 2U);
  EXPECT_EQ(errors.far_off, 1U);
  EXPECT_NEAR(errors.bias_mm, 0.1, 1e-6);
  EXPECT_NEAR(errors.rms_mm, std::sqrt((0.09 + 0.01) / 2), 1e-6);
  EXPECT_NEAR(errors.predicted_rms_mm, 0.1, 1e-12);
  EXPECT_NEAR(errors.mean_nees, 5, 1e-5);
  EXPECT_EQ(errors.in_95_percent, 0.5);
  EXPECT_EQ(cloud_errors({}, surface, 5).points, 0U);
}

/// A wall on a platform that sways, and a scanner before it; targets do not matter here.
Cell wall_cell() {
  Cell cell = test_cell();
  const RigidMotion platform = pose_at(cell.movers[0].motion, 0);
  Sweep sway;
  sway.tracker_from_rest = platform;
  sway.yaw = {rad_from_deg(4), 0.3, 0};
  sway.pitch = {rad_from_deg(4), 0.2, 0.5};
  cell.movers[0].motion = sway;
  cell.workpiece = Solid{
      "wall", std::make_shared<TriangleMesh>(mesh_of(Box{{1000, 1000, 20}})), "platform", {}, std::nullopt};
  cell.movers.push_back(
      {{"scanner", cell.movers[0].body.targets},
       at_rest(platform * RigidMotion{exp_rotation({std::numbers::pi - 0.3, 0, 0}), {0, -90, 310}})});
  cell.scanner = Scanner{};
  return cell;
}

Mat6 pose_covariance() {
  Vec6 sigmas;
  sigmas << Vec3(2, 3, 4) * 1e-5, Vec3(0.01, 0.015, 0.03);
  return sigmas.cwiseAbs2().asDiagonal();
}

/// What a tracker would tell of both bodies, 20 times a second.
std::vector<PoseRecord> tracked(const Cell& cell, std::uint64_t seed) {
  std::vector<PoseRecord> records;
  for (int frame = 0; frame < 16; ++frame) {
    const double time_s = 0.05 * frame;
    const auto poses = poses_at(cell, time_s);
    for (std::size_t body = 0; body < 2; ++body) {
      RandomStream random(seed, static_cast<std::uint64_t>(frame) * 2 + body);
      Vec6 error;
      for (double& each : error) each = random.normal();
      PoseRecord record;
      record.frame = frame;
      record.time_s = time_s;
      record.body = cell.movers[body].body.name;
      record.covariance = pose_covariance();
      record.tracker_from_body =
          perturbed(poses[body], record.covariance->diagonal().cwiseSqrt().cwiseProduct(error));
      records.push_back(record);
    }
  }
  return records;
}

ScanChain chain_of(const Cell& cell, std::uint64_t seed) {
  const auto records = tracked(cell, seed);
  ScanChain chain;
  chain.scanner = track_of(records, "scanner");
  chain.reference = track_of(records, "platform");
  chain.body_from_scanner = cell.scanner->body_from_scanner;
  Vec6 place;
  place << Vec3::Constant(rad_from_deg(cell.scanner->place_sigma_deg)),
      Vec3::Constant(cell.scanner->place_sigma_mm);
  chain.of_body_from_scanner = place.cwiseAbs2().asDiagonal();
  chain.reference_from_workpiece = cell.workpiece->carrier_from_solid;
  return chain;
}

TEST(CarriedErrors, OfASimulatedScanAgreeWithTheirCovariance) {
  Cell cell = wall_cell();
  cell.scanner->outlier_share = 0;
  const Stage stage = stage_of(cell);
  constexpr std::size_t kRuns = 60;
  double nees = 0, squares = 0, predicted = 0;
  for (std::size_t run = 1; run <= kRuns; ++run) {
    const SimulatedScan made = simulate_scan(stage, {1, 0.3, 0.36}, run);
    ASSERT_GT(made.scan.in_scanner.size(), 500U);
    const CarriedScan scan = carried(made.scan, chain_of(cell, run), *cell.scanner, {});
    ASSERT_EQ(scan.left_out(), 0U);
    const CarriedErrors errors = carried_errors(scan, made.true_in_workpiece);
    nees += errors.mean_nees / kRuns;
    squares += errors.rms_mm * errors.rms_mm;
    predicted += errors.predicted_rms_mm * errors.predicted_rms_mm;
  }
  // Points of a run share its poses: in the worst case a run is one draw of three degrees.
  EXPECT_TRUE(chi_square_mean_band(kRuns, 3, 0.99).holds(nees)) << nees;
  EXPECT_NEAR(std::sqrt(squares / predicted), 1, 0.15);
}

TEST(CloudErrors, OfAFusedSimulatedScanAgreeWithTheirCovariance) {
  const Cell cell = wall_cell();
  const Stage stage = stage_of(cell);
  const SurfaceTree surface(*cell.workpiece->surface);
  constexpr std::size_t kRuns = 40;
  double nees = 0, squares = 0, predicted = 0;
  for (std::size_t run = 1; run <= kRuns; ++run) {
    const Scan raw = simulate_scan(stage, {1, 0.3, 0.36}, run).scan;
    const Scan scan = cleaned(raw, surface_of(raw, *cell.scanner, {}));
    const ScanChain chain = chain_of(cell, run);
    const CarriedScan on_part = carried(scan, chain, *cell.scanner, {});
    CloudFusion fusion({3, 0.001, 1});
    for (std::size_t part = 0; part < on_part.parts.size(); ++part)
      fusion.add(1, static_cast<int>(part), on_part.poses, on_part.parts[part].points);
    const CloudErrors errors = cloud_errors(fusion.cloud().points, surface, 3);
    ASSERT_GT(errors.points, 300U);
    nees += errors.mean_nees / kRuns;
    squares += errors.rms_mm * errors.rms_mm;
    predicted += errors.predicted_rms_mm * errors.predicted_rms_mm;
  }
  EXPECT_TRUE(chi_square_mean_band(kRuns, 1, 0.99).holds(nees)) << nees;
  EXPECT_LT(std::sqrt(squares / predicted), 1.1);
}

}  // namespace
}  // namespace asterism
