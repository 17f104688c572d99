// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/plan_file.hpp"

#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

ScanPlan plan() {
  ScanPlan plan;
  plan.samples = {{{1.0 / 3, 2, 3}, {0, 0, 1}, 7, 12.5, 1}, {{4, 5, 6}, {0, 1, 0}, 8, 12.5, 0}};
  plan.poses = {{0, 0, 0, {}}, {0, 15, -15, {exp_rotation({0.1, 0.2, 0.3}), {1, 2, 3}}}};
  PlannedView view;
  view.workpiece_from_scanner = {exp_rotation({1, 2, 0.1}), {100.1, -20, 1e-7}};
  view.platform_pose = 1;
  view.measures = {0, 1};
  view.adds_mm2 = 25;
  view.mean_incidence_deg = 31.25;
  view.beyond_good_incidence = 0.1;
  view.worst_sigma_mm = 0.07;
  view.scanner_targets = 6;
  view.platform_targets = 5;
  view.starts_s = 10.5;
  plan.views = {view};
  plan.bound = 1;
  plan.optimal = true;
  plan.greedy_views = 2;
  plan.candidates = 99;
  plan.in_words = "1 view, optimal";
  plan.surface_mm2 = 30, plan.reachable_mm2 = 29, plan.coverable_mm2 = 28, plan.covered_mm2 = 27;
  plan.covered_before_mm2 = 2;
  plan.limits = {{ScanLimit::ScannerTargets, 1.5}};
  plan.covered_before = {1};
  plan.tour_s = 5.5, plan.nearest_neighbour_s = 6;
  plan.remarks = {"the underside"};
  return plan;
}

TEST(PlanFile, ComesBackAsItWas) {
  const TestFolder folder;
  write_plan(folder / "plan.json", plan());
  const ScanPlan back = read_plan(folder / "plan.json"), before = plan();
  ASSERT_EQ(back.views.size(), 1U);
  const PlannedView &a = back.views[0], &b = before.views[0];
  EXPECT_EQ(a.workpiece_from_scanner.translation, b.workpiece_from_scanner.translation);
  EXPECT_EQ(a.workpiece_from_scanner.rotation.coeffs(), b.workpiece_from_scanner.rotation.coeffs());
  EXPECT_EQ(a.measures, b.measures);
  EXPECT_EQ(a.platform_pose, b.platform_pose);
  EXPECT_EQ(a.worst_sigma_mm, b.worst_sigma_mm);
  EXPECT_EQ(a.starts_s, b.starts_s);
  EXPECT_EQ(a.scanner_targets, b.scanner_targets);
  ASSERT_EQ(back.samples.size(), 2U);
  EXPECT_EQ(back.samples[0].at, before.samples[0].at);
  EXPECT_EQ(back.samples[1].weight, 0);
  ASSERT_EQ(back.poses.size(), 2U);
  EXPECT_EQ(back.poses[1].roll_deg, -15);
  EXPECT_EQ(back.poses[1].tracker_from_platform.translation, Vec3(1, 2, 3));
  EXPECT_EQ(back.in_words, before.in_words);
  EXPECT_EQ(back.coverable_mm2, 28);
  ASSERT_EQ(back.limits.size(), 1U);
  EXPECT_EQ(back.limits[0].limit, ScanLimit::ScannerTargets);
  EXPECT_EQ(back.covered_before, before.covered_before);
  EXPECT_EQ(back.remarks, before.remarks);
}

std::string complaint(const std::string& text) {
  const TestFolder folder;
  folder.write("plan.json", text);
  try {
    static_cast<void>(read_plan(folder / "plan.json"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PlanFile, SaysWhatIsMissing) {
  EXPECT_NE(complaint("{\"a\": 1}").find("asterism-plan/1"), std::string::npos);
  EXPECT_NE(complaint("{\"schema\": \"asterism-plan/1\"}").find("in_words"), std::string::npos);
  EXPECT_NE(complaint("not JSON").find("is no plan"), std::string::npos);
}

TEST(PlanFile, RefusesAViewOfASampleThatIsNotThere) {
  const TestFolder folder;
  ScanPlan wrong = plan();
  wrong.views[0].measures = {0, 2};
  write_plan(folder / "plan.json", wrong);
  EXPECT_THROW(static_cast<void>(read_plan(folder / "plan.json")), InputError);
}

}  // namespace
}  // namespace asterism
