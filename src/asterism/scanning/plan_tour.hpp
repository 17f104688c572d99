// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/cell/scan_task.hpp"
#include "asterism/scanning/cell_sight.hpp"
#include "asterism/scanning/plan_cover.hpp"

namespace asterism {

/// How long it takes from one view to the start of the next: the view itself, then the way (the longer of
/// moving and turning, in the tracker's frame) and, where the platform turns meanwhile, its turn if that
/// takes longer; then a rest.
[[nodiscard]] double seconds_between(const ScanTask& task, const CellSight& sight,
                                     const CandidateStudy& study, const ChosenView& from,
                                     const ChosenView& to);

struct PlanTour {
  std::vector<std::uint32_t> order;  // of the chosen views
  std::vector<double> starts_s;      // in that order; the first rests first
  double tour_s = 0;                 // until the last view's end
  double nearest_neighbour_s = 0;
};

/// From rest through all views, by optimization/tour; the platform turns where that costs less than coming by
/// again.
[[nodiscard]] PlanTour plan_tour(const PlanGround& ground, const CandidateStudy& study,
                                 std::span<const ChosenView> chosen);

}  // namespace asterism
