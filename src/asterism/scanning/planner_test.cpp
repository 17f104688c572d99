// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/planner.hpp"

#include <gtest/gtest.h>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/scanning/cell_sight.hpp"
#include "asterism/scanning/scan_cell_for_tests.hpp"

namespace asterism {
namespace {

PlanOptions small() {
  PlanOptions options;
  options.samples = 500;
  options.candidates = 250;
  options.candidates_more = 90;
  options.rounds = 1;
  options.platform_steps = 1;
  options.cover.exact_s = 0;
  options.cover.local_steps = 2000;
  return options;
}

ScanPlan plan(const Cell& cell, const PlanOptions& options = small(), const EarlierCloud& earlier = {}) {
  return plan_scans(cell, options, 1, earlier, no_progress);
}

TEST(PlanScans, MeasuresWhatItSaysFromWhereItSays) {
  Cell cell = scene::scan_cell();
  const ScanPlan found = plan(cell);
  ASSERT_FALSE(found.views.empty());
  const CellSight sight(cell, found.poses, 4);
  const RayScene part(*cell.workpiece->surface);
  std::vector<int> times(found.samples.size(), 0);
  double starts = 0;
  for (const PlannedView& view : found.views) {
    const RigidMotion& pose = view.workpiece_from_scanner;
    const Sighting sighting = sight.look(view.platform_pose, std::span(&pose, 1)).front();
    EXPECT_EQ(sighting.fails, 0U);
    EXPECT_EQ(sighting.scanner_targets, view.scanner_targets);
    EXPECT_GE(view.platform_targets, 4);
    EXPECT_GT(view.starts_s, starts);
    starts = view.starts_s;
    for (const std::uint32_t i : view.measures) {
      ++times[i];
      EXPECT_EQ(failing_limits(*cell.scanner, pose.inverse(), found.samples[i]), 0U);
      EXPECT_TRUE(in_sight(*cell.scanner, pose, found.samples[i], part));
      EXPECT_LE(sigma_along_normal_mm(*cell.scanner, pose, *sighting.covariance, found.samples[i]),
                cell.scan_task.tolerance_mm);
    }
  }
  double covered = 0, added = 0;
  for (std::size_t i = 0; i < times.size(); ++i) covered += times[i] > 0 ? found.samples[i].area_mm2 : 0;
  for (const PlannedView& view : found.views) added += view.adds_mm2;
  EXPECT_NEAR(covered, found.covered_mm2, 1e-6 * covered);
  EXPECT_NEAR(added, found.covered_mm2, 1e-6 * covered);
  EXPECT_GE(found.covered_mm2, 0.99 * found.coverable_mm2 - 1e-6 * covered);
  EXPECT_LE(found.coverable_mm2, found.reachable_mm2);
  EXPECT_LE(found.reachable_mm2, found.surface_mm2 * (1 + 1e-12));
  EXPECT_GE(found.views.size(), found.bound);
  EXPECT_LE(found.tour_s, found.nearest_neighbour_s + 1e-9);
}

TEST(PlanScans, IsTheSameOnAnyNumberOfThreads) {
  const Cell cell = scene::scan_cell();
  set_thread_count(1);
  const ScanPlan alone = plan(cell);
  set_thread_count(0);
  const ScanPlan many = plan(cell);
  ASSERT_EQ(alone.views.size(), many.views.size());
  for (std::size_t i = 0; i < alone.views.size(); ++i) {
    EXPECT_EQ(alone.views[i].measures, many.views[i].measures);
    EXPECT_EQ(alone.views[i].workpiece_from_scanner.translation,
              many.views[i].workpiece_from_scanner.translation);
  }
}

TEST(PlanScans, TellsExactlyWhatALimitCosts) {
  Cell cell = scene::scan_cell();
  cell.scan_task.floor_mm = 60;
  PlanOptions options = small();
  options.rounds = 0;  // else other candidates come in
  const ScanPlan with = plan(cell, options);
  options.asked.on[static_cast<std::size_t>(ScanLimit::Floor)] = false;
  const ScanPlan without = plan(cell, options);
  const auto floor = std::find_if(with.limits.begin(), with.limits.end(),
                                  [](const LimitCost& cost) { return cost.limit == ScanLimit::Floor; });
  ASSERT_NE(floor, with.limits.end());
  EXPECT_GT(floor->area_mm2, 0);
  EXPECT_NEAR(with.coverable_mm2 + floor->area_mm2, without.coverable_mm2, 1e-6 * with.surface_mm2);
}

TEST(PlanScans, MeasuresEachPlaceAsOftenAsAsked) {
  Cell cell = scene::scan_cell();
  cell.scan_task.views_each = 2;
  cell.scan_task.share = 1;
  const ScanPlan twice = plan(cell);
  cell.scan_task.views_each = 1;
  const ScanPlan once = plan(cell);
  EXPECT_GT(twice.views.size(), once.views.size());
  std::vector<int> times(twice.samples.size(), 0);
  for (const PlannedView& view : twice.views) {
    for (const std::uint32_t i : view.measures) ++times[i];
  }
  double area = 0;
  for (std::size_t i = 0; i < times.size(); ++i) area += times[i] >= 2 ? twice.samples[i].area_mm2 : 0;
  EXPECT_GT(area, 0.95 * twice.coverable_mm2);  // a few places have one candidate only
}

TEST(PlanScans, PlansOnlyWhatAnEarlierCloudLacks) {
  const Cell cell = scene::scan_cell();
  const ScanPlan whole = plan(cell);
  EarlierCloud earlier;
  for (const SurfaceSample& sample : whole.samples) {
    if (sample.at.x() > 0) continue;
    for (int i = 0; i < 3; ++i) earlier.cloud.points.push_back(sample.at + Vec3(0, 0, 0.01 * i));
  }
  const ScanPlan rest = plan(cell, small(), earlier);
  EXPECT_LT(rest.views.size(), whole.views.size());
  EXPECT_NEAR(rest.covered_before_mm2, 0.5 * rest.surface_mm2, 0.05 * rest.surface_mm2);
  EXPECT_GE(rest.covered_mm2, 0.99 * rest.coverable_mm2 - 1e-6 * rest.surface_mm2);
}

TEST(PlanScans, LeastTimeTurnsThePlatformOnlyWhereThatPays) {
  Cell cell = scene::scan_cell();
  PlanOptions options = small();
  options.objective = PlanObjective::Time;
  options.platform_steps = 3;
  options.candidates = 120;
  options.rounds = 0;
  cell.platform->stroke.yaw_deg = 0;
  cell.scan_task.turn_s = 1e4;
  cell.scan_task.share = 0.5;
  EXPECT_EQ(plan(cell, options).poses.size(), 1U);
}

TEST(PlanScans, KeepsToTheRings) {
  PlanOptions options = small();
  options.method = PlanMethod::Rings;
  options.ring_step_deg = 30;
  const ScanPlan found = plan(scene::scan_cell(), options);
  EXPECT_EQ(found.candidates, 12U);  // one ring: the tube is 200 mm high
}

TEST(PlanScans, NamesTheLimitThatForbidsEverything) {
  Cell cell = scene::scan_cell();
  cell.scanner->clearance_mm = 5000;
  try {
    static_cast<void>(plan(cell));
    FAIL();
  } catch (const MeasurementError& error) {
    EXPECT_NE(std::string(error.what()).find("clearance of the scanner"), std::string::npos) << error.what();
  }
  cell = scene::scan_cell();
  cell.movers[1].body.targets.resize(3);
  EXPECT_THROW(static_cast<void>(plan(cell)), MeasurementError);
}

TEST(PlanScans, RefusesAPartWhoseOutsideCannotBeTold) {
  Cell cell = scene::scan_cell();
  TriangleMesh mesh = scene::tube();
  cell.workpiece->surface = std::make_shared<const TriangleMesh>(flipped(mesh));
  EXPECT_THROW(static_cast<void>(plan(cell)), InputError);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  cell.workpiece->surface = std::make_shared<const TriangleMesh>(mesh);
  EXPECT_THROW(static_cast<void>(plan(cell)), InputError);
  cell.workpiece.reset();
  EXPECT_THROW(static_cast<void>(plan(cell)), InputError);
}

TEST(PlanScans, SaysThatAPartOnATableWantsTurningOver) {
  Cell cell = scene::scan_cell();
  const TriangleMesh table = surface_of_revolution({{0, -20}, {300, -20}, {300, -0.5}, {0, -0.5}}, 60);
  cell.fixtures = {Solid{"table", std::make_shared<const TriangleMesh>(table), "platform", {}, {}}};
  const ScanPlan found = plan(cell);
  EXPECT_TRUE(std::any_of(found.remarks.begin(), found.remarks.end(), [](const std::string& remark) {
    return remark.find("turn the part over") != std::string::npos;
  }));
  EXPECT_GT(found.reachable_mm2, found.coverable_mm2);
}

}  // namespace
}  // namespace asterism
