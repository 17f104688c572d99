// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/scanning/plan_findings.hpp"
#include "asterism/scanning/plan_tour.hpp"

namespace asterism {
namespace {

void check_plannable(const Cell& cell) {
  if (!cell.workpiece) throw InputError(cell.name, "it has no [workpiece]; there is nothing to scan");
  if (!cell.scanner) throw InputError(cell.name, "it has no [scanner]; a plan of views needs one");
  const MeshFacts facts = facts_of(*cell.workpiece->surface);
  if (facts.flipped_edges > 0) {
    throw InputError(cell.name,
                     fmt::format("workpiece `{}`: triangles face different ways ({} edges between such); its "
                                 "outside cannot be told, so what a view sees of it cannot either",
                                 cell.workpiece->name, facts.flipped_edges));
  }
  if (facts.closed() && facts.volume_mm3 < 0) {
    throw InputError(cell.name,
                     fmt::format("workpiece `{}` is inside out; say `flip = true`", cell.workpiece->name));
  }
}

std::vector<std::uint32_t> measured_before(const PlanGround& ground, const EarlierCloud& earlier) {
  std::vector<std::uint32_t> samples;
  if (earlier.cloud.points.empty()) return samples;
  const Completeness complete = completeness_of(earlier.cloud, ground.samples, earlier.completeness);
  for (std::uint32_t i = 0; i < complete.measured.size(); ++i) {
    if (complete.measured[i] != 0) samples.push_back(i);
  }
  return samples;
}

double area_of(const PlanGround& ground, std::span<const std::uint64_t> bits) {
  double area = 0;
  for_each_bit(bits, [&](std::size_t i) { area += ground.samples[i].area_mm2; });
  return area;
}

PlannedView planned_view(const PlanGround& ground, const RigidMotion& workpiece_from_scanner,
                         const ChosenView& chosen) {
  PlannedView view;
  view.workpiece_from_scanner = workpiece_from_scanner;
  view.platform_pose = chosen.pose;
  view.measures = chosen.measures;
  const Scanner& scanner = *ground.cell.scanner;
  const Sighting sighting = ground.sight.look(chosen.pose, std::span(&workpiece_from_scanner, 1)).front();
  view.scanner_targets = sighting.scanner_targets;
  view.platform_targets = sighting.platform_targets;
  for (const std::uint32_t i : chosen.measures) {
    const SurfaceSample& sample = ground.samples[i];
    const Vec3 way = (workpiece_from_scanner.translation - sample.at).normalized();
    const double incidence = deg_from_rad(std::acos(std::clamp(sample.normal.dot(way), -1.0, 1.0)));
    view.mean_incidence_deg += incidence / static_cast<double>(chosen.measures.size());
    if (incidence > scanner.good_incidence_deg) {
      view.beyond_good_incidence += 1.0 / static_cast<double>(chosen.measures.size());
    }
    if (!sighting.covariance) continue;
    view.worst_sigma_mm = std::max(view.worst_sigma_mm, sigma_along_normal_mm(scanner, workpiece_from_scanner,
                                                                              *sighting.covariance, sample));
  }
  return view;
}

/// Only the poses that are used, in the order in which the tour comes to them.
void keep_used_poses(const PlanGround& ground, ScanPlan& plan) {
  std::vector<std::size_t> number(ground.sight.poses().size(), static_cast<std::size_t>(-1));
  for (PlannedView& view : plan.views) {
    std::size_t& place = number[view.platform_pose];
    if (place == static_cast<std::size_t>(-1)) {
      place = plan.poses.size();
      plan.poses.push_back(ground.sight.poses()[view.platform_pose]);
    }
    view.platform_pose = place;
  }
}

void tell_areas(const PlanGround& ground, const CandidateStudy& study, ScanPlan& plan) {
  SampleBits covered(study.rows.words(), 0), coverable = study.coverable, reachable = study.reachable;
  for (const std::uint32_t i : plan.covered_before) {
    set_bit(covered, i);
    set_bit(coverable, i);
    set_bit(reachable, i);
  }
  plan.covered_before_mm2 = area_of(ground, covered);
  for (PlannedView& view : plan.views) {
    for (const std::uint32_t i : view.measures) {
      if (!bit_at(covered, i)) view.adds_mm2 += ground.samples[i].area_mm2;
      set_bit(covered, i);
    }
  }
  plan.covered_mm2 = area_of(ground, covered);
  plan.coverable_mm2 = area_of(ground, coverable);
  plan.reachable_mm2 = area_of(ground, reachable);
  for (const SurfaceSample& sample : ground.samples) plan.surface_mm2 += sample.area_mm2;
}

}  // namespace

ScanPlan plan_scans(const Cell& cell, const PlanOptions& options, std::uint64_t seed,
                    const EarlierCloud& earlier, const Progress& progress) {
  check_plannable(cell);
  const PlanGround ground = plan_ground(cell, options, seed);
  ScanPlan plan;
  plan.samples = ground.samples;
  plan.covered_before = measured_before(ground, earlier);
  const CandidateStudy study = study_candidates(ground, plan.covered_before, seed, progress);
  if (study.allowed.empty()) {
    if (study.forbidden.empty()) {
      throw MeasurementError(fmt::format(
          "no viewpoint of {} measures anything of `{}`: within {:g} to {:g} mm the part hides itself",
          study.views.size(), cell.workpiece->name, cell.scanner->near_mm, cell.scanner->far_mm));
    }
    throw MeasurementError(
        fmt::format("no view of `{}` can be taken in this cell. What forbids views, in "
                    "every pose of the platform: {}",
                    cell.workpiece->name, why_none_is_allowed(ground, study)));
  }
  const PlanProblem problem = plan_problem(ground, study, plan.covered_before);
  progress("choosing views", 0, 1);
  const SetCover cover = solve(problem.cover, options.cover, seed, progress);
  progress("choosing views", 1, 1);

  std::vector<ChosenView> chosen;
  if (problem.by_time) {
    for (const std::uint32_t column : cover.chosen) {
      const AllowedView& view = study.allowed[column];
      chosen.push_back({view.view, view.pose, view.measures});
    }
  } else {
    chosen = in_few_poses(ground, study, cover.chosen);
  }
  const PlanTour tour = plan_tour(ground, study, chosen);
  for (std::size_t i = 0; i < tour.order.size(); ++i) {
    const ChosenView& view = chosen[tour.order[i]];
    plan.views.push_back(planned_view(ground, study.views[view.view].workpiece_from_scanner, view));
    plan.views.back().starts_s = tour.starts_s[i];
  }
  keep_used_poses(ground, plan);
  const std::size_t turns = plan.poses.empty() ? 0 : plan.poses.size() - 1;
  plan.optimal = cover.optimal;
  plan.bound =
      static_cast<std::size_t>(std::ceil(cover.bound * (problem.by_time ? problem.view_cost_s : 1.0) - 1e-6));
  plan.greedy_views = static_cast<std::size_t>(std::lround(cover.greedy_cost));
  plan.candidates = study.views.size() * ground.sight.poses().size();
  plan.in_words = words_of(cover, problem, plan.views.size(), turns);
  plan.tour_s = tour.tour_s;
  plan.nearest_neighbour_s = tour.nearest_neighbour_s;
  tell_areas(ground, study, plan);
  progress("what limits cost", 0, 1);
  plan.limits = limit_costs(ground, study);
  plan.remarks = plan_remarks(ground, study, plan);
  progress("what limits cost", 1, 1);
  return plan;
}

}  // namespace asterism
