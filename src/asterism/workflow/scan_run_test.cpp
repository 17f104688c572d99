// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/scan_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/cell/frame_chain.hpp"
#include "asterism/cell/occluders.hpp"
#include "asterism/core/files_for_tests.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/simulation/read_out.hpp"

namespace asterism {
namespace {

/// Views around the built-in cell's casing, 300 mm off its wall, on two platform poses.
ScanPlan plan_for(const Cell& cell) {
  ScanPlan plan;
  const RigidMotion base = tracker_from_base(cell);
  for (const double yaw_deg : {0.0, 15.0}) {
    PlatformPose pose{yaw_deg, 0, 0, {}};
    pose.tracker_from_platform =
        base *
        rotation_about(cell.platform->pivot_mm, rotation_from_yaw_pitch_roll(rad_from_deg(yaw_deg), 0, 0));
    plan.poses.push_back(pose);
  }
  for (int i = 0; i < 4; ++i) {
    const double angle = rad_from_deg(90 * i);
    Mat3 axes;
    axes.col(2) = -Vec3(std::cos(angle), std::sin(angle), 0);
    axes.col(1) = -Vec3::UnitZ();
    axes.col(0) = axes.col(1).cross(axes.col(2));
    PlannedView view;
    view.workpiece_from_scanner = {quaternion_from_matrix(axes), Vec3(0, 0, 280) - 790 * axes.col(2)};
    view.platform_pose = i < 2 ? 0 : 1;
    plan.views.push_back(view);
  }
  return plan;
}

double speed_at(const Cell& cell, const std::string& body, double time_s) {
  constexpr double kStep_s = 1e-4;
  const auto place = [&](double t) {
    return poses_at(cell, t)[static_cast<std::size_t>(mover_index(cell, body))] * Vec3(500, 0, 0);
  };
  return (place(time_s + kStep_s) - place(time_s - kStep_s)).norm() / (2 * kStep_s);
}

TEST(ScanRun, MeasuresEachViewWhereThePlanPutsItAndStandsStillThere) {
  const Cell cell = cell_of("engine_casing");
  const ScanPlan plan = plan_for(cell);
  const Cell run = scan_run(cell, plan, {});
  EXPECT_NO_THROW(check_cell(run, "run"));  // within the platform's stroke and rates too
  ASSERT_EQ(run.passes.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const ScanPass& pass = run.passes[i];
    EXPECT_EQ(pass.scan, static_cast<int>(i) + 1);
    EXPECT_NEAR(pass.to_s - pass.from_s, cell.scan_task.view_s, 1e-9);
    for (const double t :
         {pass.from_s - 2 / run.timing.rate_hz, pass.from_s, pass.to_s, pass.to_s + 2 / run.timing.rate_hz}) {
      EXPECT_EQ(speed_at(run, "scanner", t), 0) << t;
      EXPECT_EQ(speed_at(run, "platform", t), 0) << t;
      const Vec6 off = difference(frame_chain_at(run, t).workpiece_from_scanner.value(),
                                  plan.views[i].workpiece_from_scanner);
      EXPECT_LT(off.norm(), 1e-9);
    }
  }
  EXPECT_LE(run.passes.back().to_s, (run.timing.frames - 1) / run.timing.rate_hz);
}

TEST(ScanRun, TakesAsLongAsTheTaskSaysAndLessAtAHigherPace) {
  Cell cell = cell_of("engine_casing");
  const ScanPlan plan = plan_for(cell);
  const double usual_s = scan_run(cell, plan, {}).passes.back().to_s;
  EXPECT_GT(usual_s, 4 * 5 + 10) << "four views and a turn";
  ScanRunOptions hurried;
  hurried.pace = 10;
  hurried.view_s = 0.5;
  hurried.first_scan = 7;
  const Cell run = scan_run(cell, plan, hurried);
  EXPECT_LT(run.passes.back().to_s, usual_s / 4);
  EXPECT_EQ(run.passes.front().scan, 7);
  EXPECT_NO_THROW(check_cell(run, "run"));
  hurried.pace = 1000;
  EXPECT_NO_THROW(check_cell(scan_run(cell, plan, hurried), "run")) << "the platform keeps its rates";
}

TEST(ScanRun, TheScannerGoesAroundThePart) {
  const Cell cell = cell_of("engine_casing");
  ScanPlan plan = plan_for(cell);
  plan.views = {plan.views[0], plan.views[2]};  // on opposite sides
  const Cell run = scan_run(cell, plan, {});
  for (double t = run.passes[0].to_s; t < run.passes[1].from_s; t += 0.05) {
    const Vec3 at = frame_chain_at(run, t).workpiece_from_scanner->translation;
    EXPECT_GT(at.head<2>().norm(), 560) << "outside the casing and its flanges at " << t << " s";
  }
}

TEST(ScanRun, SwaysSteadilyWhileAViewIsMeasured) {
  const Cell cell = cell_of("engine_casing");
  ScanPlan plan = plan_for(cell);
  plan.views = {plan.views[0], plan.views[1]};
  ScanRunOptions options;
  options.sway_deg = 3;
  const Cell run = scan_run(cell, plan, options);
  EXPECT_NO_THROW(check_cell(run, "run"));
  const ScanPass& pass = run.passes[1];
  EXPECT_EQ(speed_at(run, "scanner", pass.from_s), 0);
  EXPECT_GT(speed_at(run, "platform", (pass.from_s + pass.to_s) / 2), 5);  // 6° in 5 s, 500 mm out: 10 mm/s
  const auto turned = [&](double t) {
    return deg_from_rad(rotation_angle(poses_at(run, t)[0].rotation, tracker_from_base(cell).rotation));
  };
  EXPECT_GT(turned(pass.from_s), 2.5);
  EXPECT_GT(turned(pass.to_s), 2.5);
  EXPECT_LT(turned((pass.from_s + pass.to_s) / 2), 0.05);
}

TEST(ScanRun, TellsWhatIsMissing) {
  Cell cell = cell_of("engine_casing");
  const ScanPlan plan = plan_for(cell);
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(scan_run(cell, {}, {})); }), "has no views");
  cell.workpiece.reset();
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(scan_run(cell, plan, {})); }), "has no [workpiece]");
  cell.scanner.reset();
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(scan_run(cell, plan, {})); }), "has no [scanner]");
}

}  // namespace
}  // namespace asterism
