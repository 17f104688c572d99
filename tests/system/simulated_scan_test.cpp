// SPDX-License-Identifier: Apache-2.0
// A plan carried out in a simulated cell: its scans, carried to the part by what the tracker measures,
// against the part's true surface.
#include <gtest/gtest.h>

#include <cmath>

#include "asterism/evaluation/scan_errors.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/scanning/scan_surface.hpp"
#include "asterism/simulation/read_out.hpp"
#include "asterism/simulation/scan.hpp"
#include "asterism/simulation/simulate.hpp"
#include "asterism/statistics/intervals.hpp"
#include "asterism/tracking/tracker.hpp"
#include "asterism/workflow/scan_run.hpp"

namespace asterism {
namespace {

/// The built-in cell with wider lenses, that see the scanner beside the part too.
Cell wide_cell() {
  Cell cell = cell_of("engine_casing");
  for (Lens* lens : {&cell.rig.left, &cell.rig.right}) {
    lens->fx /= 2;
    lens->fy /= 2;
  }
  cell.volume.reset();
  return cell;
}

/// Two views of the casing's wall from the tracker's side, so that the scanner's targets face the tracker.
ScanPlan plan_for(const Cell& cell) {
  ScanPlan plan;
  plan.poses.push_back({0, 0, 0, tracker_from_base(cell)});
  for (const double azimuth_deg : {40.0, 55.0}) {
    const double azimuth = rad_from_deg(azimuth_deg), elevation = rad_from_deg(30);
    const Vec3 out(std::cos(azimuth), std::sin(azimuth), 0);
    const Vec3 at_wall = 475 * out + Vec3(0, 0, 180);
    Mat3 axes;
    axes.col(2) = -std::cos(elevation) * out - std::sin(elevation) * Vec3::UnitZ();
    axes.col(0) = axes.col(2).cross(Vec3::UnitZ()).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    PlannedView view;
    view.workpiece_from_scanner = {quaternion_from_matrix(axes), at_wall - 300 * axes.col(2)};
    plan.views.push_back(view);
  }
  return plan;
}

/// What the tracker tells of every frame, from centres.
std::vector<PoseRecord> tracked(const Cell& cell, std::uint64_t seed) {
  SimulationOptions options;
  options.level = SimulationLevel::Centres;
  options.seed = seed;
  const Simulator simulator(cell, options);
  Tracker tracker(cell.rig, bodies_of(cell));
  std::vector<PoseRecord> records;
  for (int frame = 0; frame < cell.timing.frames; ++frame) {
    const TrackedFrame measured = tracker.process(simulator.frame(frame).centres);
    for (const BodyPose& pose : measured.poses) {
      if (!pose.estimate) continue;
      PoseRecord record;
      record.frame = frame;
      record.time_s = measured.centres.time_s;
      record.body = tracker.bodies()[static_cast<std::size_t>(pose.body)].name;
      record.status = pose.status;
      record.tracker_from_body = pose.estimate->tracker_from_body;
      record.covariance = pose.estimate->covariance;
      record.systematic = pose.estimate->systematic;
      records.push_back(record);
    }
  }
  return records;
}

ScanChain chain_of(const Cell& cell, const std::vector<PoseRecord>& records) {
  ScanChain chain;
  chain.scanner = track_of(records, cell.scanner->body);
  chain.reference = track_of(records, cell.platform->body);
  chain.body_from_scanner = cell.scanner->body_from_scanner;
  Vec6 place;
  place << Vec3::Constant(rad_from_deg(cell.scanner->place_sigma_deg)),
      Vec3::Constant(cell.scanner->place_sigma_mm);
  chain.of_body_from_scanner = place.cwiseAbs2().asDiagonal();
  chain.reference_from_workpiece = cell.workpiece->carrier_from_solid;
  return chain;
}

struct Pooled {
  double nees = 0, squares = 0, predicted = 0;
  std::size_t points = 0, left_out = 0;
};

/// Over runs with seeds of their own, so that what is one draw a run is drawn often enough.
Pooled fused_runs(const Cell& cell, std::size_t runs) {
  const Stage stage = stage_of(cell);
  const SurfaceTree surface(*cell.workpiece->surface);
  Pooled pooled;
  for (std::size_t seed = 1; seed <= runs; ++seed) {
    const ScanChain chain = chain_of(cell, tracked(cell, seed));
    CloudFusion fusion({4, 0.001, 1});
    for (const ScanPass& pass : cell.passes) {
      const Scan raw = simulate_scan(stage, pass, seed).scan;
      const CarriedScan scan =
          carried(cleaned(raw, surface_of(raw, *cell.scanner, {})), chain, *cell.scanner, {});
      pooled.left_out += scan.left_out();
      for (std::size_t part = 0; part < scan.parts.size(); ++part)
        fusion.add(scan.scan, static_cast<int>(part), scan.poses, scan.parts[part].points);
    }
    const CloudErrors errors = cloud_errors(fusion.cloud().points, surface, 2);
    pooled.points += errors.points;
    pooled.nees += errors.mean_nees / static_cast<double>(runs);
    pooled.squares += errors.rms_mm * errors.rms_mm;
    pooled.predicted += errors.predicted_rms_mm * errors.predicted_rms_mm;
  }
  return pooled;
}

class CarriedScans : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(AtRestAndSwaying, CarriedScans, testing::Values(0.0, 2.0));

TEST_P(CarriedScans, LieOffTheSurfaceAsPredicted) {
  ScanRunOptions options;
  options.view_s = 0.15;
  options.pace = 20;
  options.sway_deg = GetParam();
  const Cell cell = wide_cell();
  const Cell run = scan_run(cell, plan_for(cell), options);
  constexpr std::size_t kRuns = 16;
  const Pooled pooled = fused_runs(run, kRuns);
  EXPECT_EQ(pooled.left_out, 0U);
  EXPECT_GT(pooled.points, kRuns * 2000);
  // A run is at least one draw of one degree of freedom along a normal.
  EXPECT_TRUE(chi_square_mean_band(kRuns, 1, 0.99).holds(pooled.nees)) << pooled.nees;
  EXPECT_LT(std::sqrt(pooled.squares / pooled.predicted), 1.1);
  RecordProperty("mean_nees", std::to_string(pooled.nees));
  RecordProperty("rms_mm", std::to_string(std::sqrt(pooled.squares / kRuns)));
  RecordProperty("predicted_mm", std::to_string(std::sqrt(pooled.predicted / kRuns)));
}

}  // namespace
}  // namespace asterism
