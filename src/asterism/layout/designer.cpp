// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/designer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/layout/knee.hpp"
#include "asterism/layout/verdict.hpp"
#include "asterism/optimization/island.hpp"
#include "asterism/optimization/non_dominated_sort.hpp"

namespace asterism {
namespace {

using Q = LayoutQuantity;

constexpr double kOnSurfaceMm = 1e-6;

/// How far the farthest target is from where it may stand.
ConstraintState off_surface(const LayoutRules& rules, std::span<const Target> targets) {
  ConstraintState state{"off-surface", "mm", false, 0, 0.0, 0};
  for (const Target& target : targets) {
    const auto allowed = nearest_allowed_place(rules.surface, target.position, rules.clearance_mm);
    if (!allowed) continue;
    state.value = std::max(*state.value, (allowed->position_mm - target.position).norm());
  }
  state.violation = *state.value > kOnSurfaceMm ? *state.value : 0.0;
  return state;
}

LayoutDesign design_of(const LayoutModel& model, std::span<const Target> given, std::string origin) {
  LayoutDesign design;
  design.origin = std::move(origin);
  design.targets = model.completed(given);
  design.name = fmt::format("{} targets", design.targets.size());
  const std::vector<Vec3> positions = positions_of(design.targets);
  design.metrics = measure_layout(positions);

  QuantitySet all;
  all.fill(true);
  const double cap = std::max(model.options.identifiability_cap_mm, model.bound_on(Q::Identifiability));
  LayoutValues values = model.values(design.targets, all, cap);
  for (const LayoutQuantityInfo& info : layout_quantities()) {
    design.quantities.push_back({info.name, info.unit, info.more_is_better, values[info.quantity]});
  }
  for (const Q quantity : model.objectives) {
    design.objectives.push_back(design.quantities[static_cast<std::size_t>(quantity)]);
  }
  for (const LayoutConstraint& constraint : model.constraints) {
    design.constraints.push_back(state_of(constraint, values[constraint.quantity]));
  }
  design.constraints.push_back(off_surface(model.rules, design.targets));
  design.identifiability = values.within;
  for (const Body& other : model.others) {
    design.between_bodies.push_back(
        {other.name, identifiability_between(positions, positions_of(other.targets), {4, cap})});
  }
  design.visibility = std::move(values.visibility);
  design.accuracy = std::move(values.accuracy);
  return design;
}

std::vector<LayoutDesign> designs_of(const LayoutModel& model, const std::vector<std::vector<Vec3>>& layouts,
                                     const std::string& origin) {
  std::vector<LayoutDesign> designs(layouts.size());
  parallel_for(layouts.size(),
               [&](std::size_t i) { designs[i] = design_of(model, model.targets_at(layouts[i]), origin); });
  return designs;
}

std::vector<LayoutDesign> published_on(const LayoutModel& model) {
  std::vector<LayoutDesign> designs;
  for (const auto* table : {&paper_table1(), &paper_table9()}) {
    for (const PublishedLayout& published : *table) {
      LayoutDesign design = design_of(model, model.targets_at(published.targets), published.name);
      if (design.constraints.back().violation > 0) continue;  // off the surface
      design.name = published.name;
      designs.push_back(std::move(design));
    }
  }
  return designs;
}

std::vector<GreedyDesign> greedy_of(const LayoutProblem& problem) {
  std::vector<GreedyDesign> designs;
  for (const GreedyLayout& greedy : problem.greedy()) {
    if (static_cast<int>(greedy.places.size()) < problem.model().rules.fewest) continue;
    std::vector<Vec3> layout;
    for (const std::size_t i : greedy.places) layout.push_back(problem.greedy_places()[i].position_mm);
    GreedyDesign one;
    one.design = designs_of(problem.model(), {layout}, "greedy").front();
    one.design.name += ", greedy";
    one.gain = greedy.gain;
    one.upper_bound = greedy.upper_bound;
    one.guaranteed = greedy.guaranteed;
    one.places = problem.greedy_places().size();
    designs.push_back(std::move(one));
  }
  return designs;
}

/// The rows of the whole front that are told in full: the knee, the extremes of the front and those of each
/// number of targets, then the most different.
std::vector<std::size_t> rows_to_tell(const std::vector<Candidate>& found, std::span<const double> objectives,
                                      std::size_t m, std::size_t most) {
  const std::vector<std::size_t> rows = thinned(objectives, m, most);
  std::vector<std::size_t> order(rows);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t i) {
      return std::pair(found[i].genes.size(),
                       std::vector<double>(objectives.begin() + i * m, objectives.begin() + (i + 1) * m));
    };
    return key(a) < key(b);
  });
  return order;
}

/// What was found with every line of sight asked: the front is what then holds the constraints and is not
/// dominated; without one, the closest is told with what it then misses. Where nothing can be hidden, this is
/// what was found.
OptimizationResult asked_exactly(const LayoutProblem& problem, OptimizationResult found) {
  if (problem.shadows().empty()) return found;
  const std::vector<ConstraintInfo> constraints = problem.constraints();
  std::vector<Candidate> asked = std::move(found.front);
  found.front.clear();
  if (asked.empty() && !found.closest.genes.empty()) asked = {found.closest};
  if (asked.empty()) return found;
  parallel_for(asked.size(), [&](std::size_t i) {
    asked[i].violations.resize(constraints.size());
    problem.evaluate_exactly(asked[i].genes, asked[i].objectives, asked[i].violations);
  });
  const auto missing = [&](const Candidate& one) { return total_violation(one.violations, constraints); };
  found.closest = *std::min_element(asked.begin(), asked.end(), [&](const Candidate& a, const Candidate& b) {
    return missing(a) < missing(b);
  });
  found.shortfalls.clear();
  for (std::size_t c = 0; c < constraints.size(); ++c) {
    const double violation = found.closest.violations[c];
    if (violation > 0) found.shortfalls.push_back({constraints[c], violation});
  }
  std::erase_if(asked, [&](const Candidate& one) { return missing(one) > 0; });
  std::vector<double> objectives;
  for (const Candidate& one : asked) {
    objectives.insert(objectives.end(), one.objectives.begin(), one.objectives.end());
  }
  const std::vector<int> ranks = non_dominated_ranks(objectives, problem.model().objectives.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (ranks[i] == 0) found.front.push_back(std::move(asked[i]));
  }
  return found;
}

void tell_front(const LayoutProblem& problem, const std::vector<Candidate>& found, DesignResult& result) {
  const LayoutModel& model = problem.model();
  const std::size_t m = model.objectives.size();
  std::vector<double> objectives;
  for (const Candidate& candidate : found) {
    objectives.insert(objectives.end(), candidate.objectives.begin(), candidate.objectives.end());
  }
  const std::size_t knee = knee_of(objectives, m);
  const auto rows = rows_to_tell(found, objectives, m, static_cast<std::size_t>(model.options.most_designs));
  std::vector<std::vector<Vec3>> layouts;
  std::vector<double> told;
  for (const std::size_t row : rows) {
    layouts.push_back(positions_of(found[row].genes));
    told.insert(told.end(), found[row].objectives.begin(), found[row].objectives.end());
    if (row == knee) result.knee = static_cast<int>(layouts.size()) - 1;
  }
  result.front = designs_of(model, layouts, "found");
  std::vector<int> of_count(kMaxTargets + 1);
  for (LayoutDesign& design : result.front) {
    design.name += fmt::format(", {}", ++of_count[design.targets.size()]);
  }
  result.why = why_the_knee(result.front, static_cast<std::size_t>(result.knee), found.size());
  for (const LayoutDesign& design : result.front)
    result.given_up.push_back(given_up_by(design, result.front));
}

}  // namespace

LayoutDesign evaluate_layout(const Cell& cell, std::span<const Target> targets,
                             const DesignerOptions& options) {
  if (targets.size() < 3 || targets.size() > kMaxTargets) {
    throw InputError("layout",
                     fmt::format("a layout has 3 to {} targets, not {}", kMaxTargets, targets.size()));
  }
  return design_of(LayoutModel(cell, options), targets, "given");
}

DesignResult design_result(const LayoutProblem& problem, const OptimizationResult& by_table) {
  const LayoutModel& model = problem.model();
  const OptimizationResult found = asked_exactly(problem, by_table);
  DesignResult result;
  result.warnings = problem.warnings();
  result.history = found.history;
  result.stopped = found.stopped;
  result.front_found = found.front.size();
  result.front_checksum = found.front_checksum;
  result.pose_times_s = model.times_s;
  if (model.present.size() >= 3) {
    result.present = design_of(model, model.present, "present");
    result.present->name = "as it stands";
  }
  result.published = published_on(model);
  result.greedy = greedy_of(problem);
  if (found.front.empty()) {
    result.infeasible = infeasibility(found);
    if (!found.closest.genes.empty()) {
      result.closest =
          design_of(model, model.targets_at(positions_of(found.closest.genes)), "closest to feasible");
    }
  } else {
    tell_front(problem, found.front, result);
  }
  return result;
}

DesignResult design_layouts(const Cell& cell, const DesignerOptions& options,
                            const OnGeneration& on_generation, const OptimizerWorkers& workers) {
  const LayoutProblem problem(cell, options);
  return design_result(problem, optimize(problem, options.optimizer, on_generation, workers));
}

}  // namespace asterism
