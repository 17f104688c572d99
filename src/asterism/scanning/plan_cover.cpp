// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/plan_cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kNoRow = static_cast<std::uint32_t>(-1);

/// The share of what is left that makes up the share of all that is asked for.
double share_of_rest(double share, double before, double rest) {
  if (!(rest > 0)) return 1;
  return std::clamp((share * (before + rest) - before) / rest, 0.0, 1.0);
}

bool includes(const std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

}  // namespace

PlanProblem plan_problem(const PlanGround& ground, const CandidateStudy& study,
                         std::span<const std::uint32_t> covered_before) {
  const ScanTask& task = ground.cell.scan_task;
  PlanProblem problem;
  std::vector<std::uint8_t> before(ground.samples.size(), 0);
  for (const std::uint32_t sample : covered_before) before[sample] = 1;
  std::vector<std::uint32_t> row_of(ground.samples.size(), kNoRow);
  double worth_before = 0, worth_left = 0;
  for (std::uint32_t i = 0; i < ground.samples.size(); ++i) {
    const double worth = ground.samples[i].worth();
    if (before[i] != 0) worth_before += worth;
    if (before[i] != 0 || !(worth > 0) || !bit_at(study.coverable, i)) continue;
    row_of[i] = static_cast<std::uint32_t>(problem.sample_of.size());
    problem.sample_of.push_back(i);
    problem.cover.weight.push_back(worth);
    worth_left += worth;
  }
  SetCoverProblem& cover = problem.cover;
  cover.rows = problem.sample_of.size();
  cover.share = share_of_rest(task.share, worth_before, worth_left);
  if (task.views_each > 1) cover.demand.assign(cover.rows, task.views_each);
  problem.by_time = ground.options.objective == PlanObjective::Time;
  problem.view_cost_s = std::max(task.view_s + task.settle_s, 1e-3);
  for (const AllowedView& view : study.allowed) {
    auto& column = cover.columns.emplace_back();
    for (const std::uint32_t sample : view.measures) {
      if (row_of[sample] != kNoRow) column.push_back(row_of[sample]);
    }
    if (problem.by_time) cover.group.push_back(view.pose);
  }
  if (problem.by_time) {
    cover.group_cost.assign(ground.sight.poses().size(), task.turn_s / problem.view_cost_s);
    cover.group_cost.front() = 0;  // the platform rests there to begin with
  }
  return problem;
}

std::vector<ChosenView> in_few_poses(const PlanGround& ground, const CandidateStudy& study,
                                     std::span<const std::uint32_t> chosen) {
  std::vector<Viewpoint> views;
  for (const std::uint32_t column : chosen) views.push_back(study.views[study.allowed[column].view]);
  const CandidateStudy anew = study_of(ground, views, true);
  SetCoverProblem problem;
  problem.rows = chosen.size();
  problem.columns.resize(ground.sight.poses().size());
  problem.cost.assign(problem.columns.size(), 1);
  problem.cost.front() = 0.01;
  std::vector<std::vector<const AllowedView*>> in_pose(problem.columns.size(),
                                                       std::vector<const AllowedView*>(chosen.size()));
  for (const AllowedView& view : anew.allowed) {
    if (!includes(view.measures, study.allowed[chosen[view.view]].measures)) continue;
    in_pose[view.pose][view.view] = &view;
  }
  for (std::size_t pose = 0; pose < in_pose.size(); ++pose) {
    for (std::uint32_t i = 0; i < chosen.size(); ++i) {
      if (in_pose[pose][i] != nullptr) problem.columns[pose].push_back(i);
    }
  }
  SetCoverOptions options;
  options.exact_s = std::min(2.0, ground.options.cover.exact_s);
  const SetCover poses = solve(problem, options, 1, no_progress);
  std::vector<std::uint32_t> open = poses.chosen;
  std::sort(open.begin(), open.end());
  std::vector<ChosenView> result;
  for (std::uint32_t i = 0; i < chosen.size(); ++i) {
    const AllowedView& first = study.allowed[chosen[i]];
    ChosenView view{first.view, first.pose, first.measures};
    for (const std::uint32_t pose : open) {
      if (in_pose[pose][i] == nullptr) continue;
      view.pose = pose;
      view.measures = in_pose[pose][i]->measures;
      break;
    }
    result.push_back(std::move(view));
  }
  return result;
}

std::string words_of(const SetCover& cover, const PlanProblem& problem, std::size_t views,
                     std::size_t turns) {
  const std::string many = fmt::format("{} view{}", views, views == 1 ? "" : "s");
  if (!problem.by_time) {
    return cover.optimal ? many + ", optimal"
                         : fmt::format("{}, bound {:.0f}", many, std::ceil(cover.bound - 1e-6));
  }
  const std::string time = fmt::format("{} and {} turn{}: {:.0f} s", many, turns, turns == 1 ? "" : "s",
                                       cover.cost * problem.view_cost_s);
  return cover.optimal ? time + ", optimal"
                       : fmt::format("{}, bound {:.0f} s", time, cover.bound * problem.view_cost_s);
}

}  // namespace asterism
