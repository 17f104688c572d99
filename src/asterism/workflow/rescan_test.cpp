// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "asterism/core/random.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/scanning/planner.hpp"

namespace asterism {
namespace {

/// Few places and few views to choose from, the platform at rest: a plan in a moment.
PlanOptions small_plan() {
  PlanOptions options;
  options.samples = 1500;
  options.candidates = 250;
  options.candidates_more = 150;
  options.rounds = 1;
  options.platform_steps = 1;
  return options;
}

/// A cloud as the scanner would make it: five points around each place that a view of the plan measures.
void scan(Cloud& cloud, const ScanPlan& plan) {
  for (std::size_t view = 0; view < plan.views.size(); ++view) {
    for (const std::uint32_t i : plan.views[view].measures) {
      const SurfaceSample& sample = plan.samples[i];
      RandomStream random(view, i);
      for (int point = 0; point < 5; ++point) {
        const Vec3 off(random.normal(), random.normal(), random.normal());
        cloud.points.push_back(sample.at + 0.03 * off);
        cloud.normals.push_back(sample.normal.cast<float>());
      }
    }
  }
}

TEST(Rescan, PlansWhatACloudLeavesOut) {
  Cell cell = cell_of("engine_casing");
  CompletenessOptions near;
  near.radius_mm = 1;  // places lie farther apart: each is measured by its own points only

  cell.scan_task.share = 0.5;
  const ScanPlan first = plan_scans(cell, small_plan(), 1, {}, no_progress);
  ASSERT_FALSE(first.views.empty());
  Cloud cloud;
  scan(cloud, first);
  const Completeness before = completeness_of(cloud, first.samples, near);
  EXPECT_NEAR(before.measured_mm2, first.covered_mm2, 1e-6 * first.surface_mm2);
  EXPECT_FALSE(before.holes.empty());

  cell.scan_task.share = 0.99;
  const ScanPlan rest = plan_scans(cell, small_plan(), 1, {cloud, near}, no_progress);
  ASSERT_FALSE(rest.views.empty());
  EXPECT_NEAR(rest.covered_before_mm2, before.measured_mm2, 1e-6 * first.surface_mm2);
  for (const PlannedView& view : rest.views) EXPECT_GT(view.adds_mm2, 0);  // none is there for what is done
  scan(cloud, rest);
  const Completeness after = completeness_of(cloud, rest.samples, near);
  EXPECT_GT(after.share(), 1.3 * before.share());  // half of what can be, then all of it
  EXPECT_NEAR(after.measured_mm2, rest.covered_mm2, 1e-6 * first.surface_mm2);
  EXPECT_GE(after.measured_mm2, 0.98 * rest.coverable_mm2);
}

}  // namespace
}  // namespace asterism
