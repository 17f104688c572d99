// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/scanning/candidate_study.hpp"

namespace asterism {

/// The set cover that a plan solves: rows are the samples that this cell lets be measured, were not measured
/// before and count; columns the allowed views.
struct PlanProblem {
  SetCoverProblem cover;
  std::vector<std::uint32_t> sample_of;  // by row
  bool by_time = false;
  double view_cost_s = 1;  // what a cost of 1 stands for, by time
};
[[nodiscard]] PlanProblem plan_problem(const PlanGround& ground, const CandidateStudy& study,
                                       std::span<const std::uint32_t> covered_before);

/// A view of the plan: which of the study's, and what it measures in its pose.
struct ChosenView {
  std::uint32_t view = 0, pose = 0;
  std::vector<std::uint32_t> measures;
};

/// The views in few poses of the platform: each view may be taken in any pose that allows it with all that it
/// measures; a second set cover opens the fewest such poses (rest costs nothing).
[[nodiscard]] std::vector<ChosenView> in_few_poses(const PlanGround& ground, const CandidateStudy& study,
                                                   std::span<const std::uint32_t> chosen);

/// "18 views, optimal", "57 views, bound 55", "20 views and 2 turns: 130 s, bound 124 s".
[[nodiscard]] std::string words_of(const SetCover& cover, const PlanProblem& problem, std::size_t views,
                                   std::size_t turns);

}  // namespace asterism
