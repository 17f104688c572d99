// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/plan_tour.hpp"

#include <algorithm>

#include "asterism/optimization/tour.hpp"

namespace asterism {
double seconds_between(const ScanTask& task, const CellSight& sight, const CandidateStudy& study,
                       const ChosenView& from, const ChosenView& to) {
  const auto placed = [&](const ChosenView& view) {
    return sight.tracker_from_part(view.pose) * study.views[view.view].workpiece_from_scanner;
  };
  const RigidMotion a = placed(from), b = placed(to);
  const double way = std::max((b.translation - a.translation).norm() / task.speed_mm_s,
                              deg_from_rad(rotation_angle(a.rotation, b.rotation)) / task.rate_deg_s);
  const double turn = from.pose == to.pose ? 0.0 : task.turn_s;
  return task.view_s + std::max(way, turn) + task.settle_s;
}

PlanTour plan_tour(const PlanGround& ground, const CandidateStudy& study,
                   std::span<const ChosenView> chosen) {
  const ScanTask& task = ground.cell.scan_task;
  // Stop 0 is where it all rests before: from there the first view costs its rest and, where the platform
  // does not rest in it, a turn.
  TourProblem problem;
  problem.stops = chosen.size() + 1;
  problem.first = 0;
  problem.time_s.assign(problem.stops * problem.stops, 0);
  for (std::size_t to = 1; to < problem.stops; ++to) {
    const ChosenView& next = chosen[to - 1];
    problem.time_s[to] = task.settle_s + (next.pose == 0 ? 0.0 : task.turn_s);
    for (std::size_t from = 1; from < problem.stops; ++from) {
      if (from == to) continue;
      problem.time_s[from * problem.stops + to] =
          seconds_between(task, ground.sight, study, chosen[from - 1], next);
    }
  }
  const Tour tour = short_tour(problem);
  PlanTour plan;
  plan.tour_s = tour.length_s + task.view_s;
  plan.nearest_neighbour_s = tour.nearest_length_s + task.view_s;
  double time = 0;
  for (std::size_t i = 1; i < tour.order.size(); ++i) {
    time += problem.time_s[tour.order[i - 1] * problem.stops + tour.order[i]];
    plan.order.push_back(tour.order[i] - 1);
    plan.starts_s.push_back(time);
  }
  return plan;
}

}  // namespace asterism
