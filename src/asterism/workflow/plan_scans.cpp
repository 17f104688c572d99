// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/plan_scans.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/io/cloud_file.hpp"
#include "asterism/io/plan_file.hpp"

namespace asterism {
namespace {

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

double m2(double mm2) { return 1e-6 * mm2; }

std::string line_of(const PlatformPose& pose, std::size_t number, std::size_t views) {
  return fmt::format("    {:>3}  yaw {:+6.1f}°  pitch {:+6.1f}°  roll {:+6.1f}°  {:>4} views\n", number,
                     pose.yaw_deg, pose.pitch_deg, pose.roll_deg, views);
}

}  // namespace

ScanPlan plan_cell(const Cell& cell, const PlanJob& job, const Progress& progress) {
  EarlierCloud earlier;
  earlier.completeness = job.completeness;
  if (!job.complete.empty()) earlier.cloud = read_cloud(job.complete);
  const ScanPlan plan = plan_scans(cell, job.options, job.seed, earlier, progress);
  if (!job.out.empty()) write_plan(job.out, plan);
  return plan;
}

std::string text_of(const ScanPlan& plan) {
  std::string text =
      fmt::format("\n  {} (of {} candidates; greedy alone: {})\n\n  covered  {:.3f} m²:", plan.in_words,
                  plan.candidates, plan.greedy_views, m2(plan.covered_mm2));
  text += fmt::format("\n    {:5.1f} % of the surface, {:.3f} m²\n",
                      100 * share(plan.covered_mm2, plan.surface_mm2), m2(plan.surface_mm2));
  text += fmt::format("    {:5.1f} % of what any view reaches, {:.3f} m²\n",
                      100 * share(plan.covered_mm2, plan.reachable_mm2), m2(plan.reachable_mm2));
  text += fmt::format("    {:5.1f} % of what this cell lets be measured, {:.3f} m²\n",
                      100 * share(plan.covered_mm2, plan.coverable_mm2), m2(plan.coverable_mm2));
  if (plan.covered_before_mm2 > 0) {
    text += fmt::format("    {:.3f} m² of it by the earlier cloud\n", m2(plan.covered_before_mm2));
  }
  if (!plan.limits.empty()) text += "\n  coverable besides, were a limit alone lifted:\n";
  for (const LimitCost& cost : plan.limits) {
    text += fmt::format("    {:5.1f} % of the surface  {}\n", 100 * share(cost.area_mm2, plan.surface_mm2),
                        text_of(cost.limit));
  }
  if (!plan.poses.empty()) text += "\n  poses of the platform:\n";
  for (std::size_t i = 0; i < plan.poses.size(); ++i) {
    std::size_t views = 0;
    for (const PlannedView& view : plan.views) views += view.platform_pose == i ? 1 : 0;
    text += line_of(plan.poses[i], i, views);
  }
  text += fmt::format("\n  tour {:.0f} s (by nearest neighbour {:.0f} s)\n", plan.tour_s,
                      plan.nearest_neighbour_s);
  for (const std::string& remark : plan.remarks) text += fmt::format("  note: {}\n", remark);
  return text;
}

nlohmann::ordered_json summary_of(const ScanPlan& plan) {
  nlohmann::ordered_json limits = nlohmann::ordered_json::object();
  for (const LimitCost& cost : plan.limits) limits[std::string(text_of(cost.limit))] = cost.area_mm2;
  double worst_sigma = 0;
  for (const PlannedView& view : plan.views) worst_sigma = std::max(worst_sigma, view.worst_sigma_mm);
  return {{"in_words", plan.in_words},
          {"views", plan.views.size()},
          {"bound", plan.bound},
          {"optimal", plan.optimal},
          {"greedy_views", plan.greedy_views},
          {"candidates", plan.candidates},
          {"platform_poses", plan.poses.size()},
          {"surface_mm2", plan.surface_mm2},
          {"reachable_mm2", plan.reachable_mm2},
          {"coverable_mm2", plan.coverable_mm2},
          {"covered_before_mm2", plan.covered_before_mm2},
          {"covered_mm2", plan.covered_mm2},
          {"limits_mm2", limits},
          {"worst_sigma_mm", worst_sigma},
          {"tour_s", plan.tour_s},
          {"nearest_neighbour_s", plan.nearest_neighbour_s},
          {"remarks", plan.remarks}};
}

}  // namespace asterism
