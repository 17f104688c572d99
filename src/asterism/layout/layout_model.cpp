// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/layout_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/checksum.hpp"
#include "asterism/core/result.hpp"
#include "asterism/layout/metrics.hpp"
#include "asterism/visibility/availability.hpp"

namespace asterism {
namespace {

using Q = LayoutQuantity;

const LayoutTask& task_of(const Cell& cell) {
  if (cell.layout) return *cell.layout;
  throw InputError(fmt::format("cell `{}`", cell.name),
                   "it states no layout task; give it a [layout] with the body, patches and points");
}

const Mover& mover_of(const Cell& cell, const std::string& body) {
  std::vector<std::string> names;
  for (const Mover& mover : cell.movers) {
    if (mover.body.name == body) return mover;
    names.push_back(mover.body.name);
  }
  throw InputError(fmt::format("cell `{}`: layout task", cell.name),
                   fmt::format("its body `{}` is not there; bodies are: {}", body, fmt::join(names, ", ")));
}

/// By how many losses an error quantity asks, and whether for the mean; none for other quantities.
struct ErrorKind {
  std::size_t losses;
  bool mean;
};
std::optional<ErrorKind> error_kind(Q quantity) {
  if (quantity < Q::WorstError || quantity > Q::MeanErrorTwoLost) return std::nullopt;
  const auto past = static_cast<std::size_t>(quantity) - static_cast<std::size_t>(Q::WorstError);
  return ErrorKind{past / 2, past % 2 == 1};
}

bool wants(const QuantitySet& wanted, std::initializer_list<Q> any) {
  return std::any_of(any.begin(), any.end(), [&](Q q) { return wanted[static_cast<std::size_t>(q)]; });
}

/// The task's own bounds, then the options', which take the place of those on the same quantity.
std::vector<LayoutConstraint> all_constraints(const LayoutTask& task, const std::string& asked) {
  std::vector<LayoutConstraint> constraints = {{Q::Visible, 4.0 + task.losses},
                                               {Q::Identifiability, task.identifiability_mm},
                                               {Q::Spacing, task.spacing_mm}};
  for (const LayoutConstraint& one : constraints_from(asked)) {
    const auto same = std::find_if(constraints.begin(), constraints.end(),
                                   [&](const LayoutConstraint& c) { return c.quantity == one.quantity; });
    if (same == constraints.end()) {
      constraints.push_back(one);
    } else {
      *same = one;
    }
  }
  return constraints;
}

std::vector<LayoutQuantity> all_objectives(const LayoutTask& task, const std::string& asked) {
  if (!asked.empty()) return objectives_from(asked);
  const Q worst = task.losses == 0   ? Q::WorstError
                  : task.losses == 1 ? Q::WorstErrorOneLost
                                     : Q::WorstErrorTwoLost;
  return {Q::Targets, worst, Q::Identifiability};
}

}  // namespace

LayoutModel::LayoutModel(const Cell& cell, const DesignerOptions& asked)
    : task(task_of(cell)), options(asked), occlusion(cell, asked.occlusion), volume(cell.volume) {
  check_layout_task(task, fmt::format("cell `{}`", cell.name));
  DesignerOptions copy = asked;
  LimitsCheck limits;
  describe(copy, limits);
  const Mover& mover = mover_of(cell, task.body);
  objectives = all_objectives(task, asked.objectives);
  constraints = all_constraints(task, asked.constraints);
  rules = {task.surface, 0.5 * task.diameter_mm, bound_on(Q::Spacing), task.fewest, task.most};
  bounds = bounds_of(task.surface);

  const double last_s = (cell.timing.frames - 1) / cell.timing.rate_hz;
  motion = seen_motion(poses_between(mover.motion, 0, last_s, task.poses), cell.rig);
  for (int i = 0; i < task.poses; ++i)
    times_s.push_back(task.poses > 1 ? last_s * i / (task.poses - 1) : 0.0);
  place_among_solids(cell);
  for (const WorkPoint& point : task.points) points.push_back(point.in_body_mm);
  present = mover.body.targets;
  for (const Mover& other : cell.movers) {
    if (other.body.name != task.body && other.body.targets.size() >= 4) others.push_back(other.body);
  }
}

void LayoutModel::place_among_solids(const Cell& cell) {
  carrier = static_cast<std::size_t>(mover_index(cell, task.body));
  for (std::size_t pose = 0; pose < times_s.size(); ++pose) {
    cell_poses.push_back(poses_at(cell, times_s[pose]));
    cell_poses.back()[carrier] = motion.tracker_from_body[pose];
  }
  Checksum mark;
  for (const Occluder& occluder : occluders_of(cell)) {
    mark.add(occluder.carrier);
    for (const Vec3& vertex : occluder.surface.vertices) mark.add(std::span(vertex.data(), 3));
    for (const auto& triangle : occluder.surface.triangles) {
      for (const std::uint32_t corner : triangle) mark.add(corner);
    }
  }
  occluders_mark = mark.value();
}

double LayoutModel::bound_on(LayoutQuantity quantity) const {
  for (const LayoutConstraint& constraint : constraints) {
    if (constraint.quantity == quantity) return constraint.bound;
  }
  return 0;
}

std::vector<Target> LayoutModel::targets_at(std::span<const Vec3> positions) const {
  std::vector<Target> targets(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    targets[i].id = fmt::format("P{}", i + 1);
    targets[i].position = positions[i];
  }
  return completed(targets);
}

std::vector<Target> LayoutModel::completed(std::span<const Target> targets) const {
  std::vector<Target> all(targets.begin(), targets.end());
  for (Target& target : all) {
    if (!target.normal) target.normal = nearest_place(task.surface, target.position).normal;
    if (!target.diameter_mm) target.diameter_mm = task.diameter_mm;
  }
  return all;
}

MotionVisibility LayoutModel::visibility_of(std::span<const Target> targets) const {
  return occlusion.unhidden_of(visible_targets(targets, motion, volume, options.visibility), targets, carrier,
                               cell_poses);
}

LayoutValues LayoutModel::values(std::span<const Target> targets, const QuantitySet& wanted,
                                 double identifiability_cap_mm) const {
  return values(targets, visibility_of(targets), wanted, identifiability_cap_mm);
}

LayoutValues LayoutModel::values(std::span<const Target> targets, MotionVisibility seen,
                                 const QuantitySet& wanted, double identifiability_cap_mm) const {
  LayoutValues values;
  values.visibility = std::move(seen);
  const auto set = [&](Q quantity, double value) { values.of[static_cast<std::size_t>(quantity)] = value; };
  const std::vector<Vec3> positions = positions_of(targets);
  set(Q::Targets, static_cast<double>(targets.size()));
  if (wants(wanted, {Q::MeanSpacing, Q::OriginDistance, Q::Coverage, Q::Thickness, Q::Spacing})) {
    const LayoutMetrics metrics = measure_layout(positions);
    set(Q::MeanSpacing, metrics.mean_pair_distance_mm);
    set(Q::OriginDistance, metrics.mean_distance_to_origin_mm);
    set(Q::Coverage, metrics.pair_distance_sum_mm);
    set(Q::Thickness, metrics.thickness_mm);
    set(Q::Spacing, metrics.min_pair_distance_mm);
  }
  if (wants(wanted, {Q::Moving})) {
    // Taking a target away and bringing another costs no less than any move.
    const double handling = 0.5 * (bounds.highest - bounds.lowest).norm();
    set(Q::Moving, moving_cost_mm(positions_of(present), positions, handling));
  }
  set(Q::Visible, fewest_visible(values.visibility));
  if (wants(wanted, {Q::Availability})) {
    set(Q::Availability, availability_over(values.visibility, task.loss_probability).mean);
  }
  predict_errors(targets, wanted, values);
  if (wants(wanted, {Q::Identifiability})) measure_identifiability(positions, identifiability_cap_mm, values);
  return values;
}

void LayoutModel::predict_errors(std::span<const Target> targets, const QuantitySet& wanted,
                                 LayoutValues& values) const {
  AccuracyOptions accuracy = options.accuracy;
  accuracy.losses = -1;
  for (const LayoutQuantityInfo& info : layout_quantities()) {
    const auto kind = error_kind(info.quantity);
    if (kind && wanted[static_cast<std::size_t>(info.quantity)])
      accuracy.losses = std::max(accuracy.losses, static_cast<int>(kind->losses));
  }
  if (accuracy.losses < 0) return;
  values.accuracy = predict_accuracy(targets, motion, values.visibility, points, accuracy);
  for (const LayoutQuantityInfo& info : layout_quantities()) {
    const auto kind = error_kind(info.quantity);
    if (!kind || kind->losses >= values.accuracy.after.size()) continue;
    const ErrorOverMotion& after = values.accuracy.after[kind->losses];
    if (after.undetermined > 0 || !after.worst) continue;
    values.of[static_cast<std::size_t>(info.quantity)] = kind->mean ? after.mean_mm : after.worst->mm;
  }
}

void LayoutModel::measure_identifiability(std::span<const Vec3> positions, double cap_mm,
                                          LayoutValues& values) const {
  std::vector<TargetMask> seen;
  for (std::size_t pose = 0; pose < values.visibility.poses(); ++pose) {
    seen.push_back(values.visibility.both(pose));
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  values.within = identifiability_margin(positions, {4, cap_mm}, seen);
  double least = values.within.rms_mm;
  for (const Body& other : others) {
    const auto margin = identifiability_between(positions, positions_of(other.targets), {4, least});
    least = std::min(least, margin.rms_mm);
  }
  values.of[static_cast<std::size_t>(Q::Identifiability)] = least;
}

}  // namespace asterism
