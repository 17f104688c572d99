// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/layout_trial.hpp"

#include <utility>

#include "asterism/cell/occluders.hpp"
#include "asterism/geometry/point_sets.hpp"

namespace asterism {
namespace {

PoseExperiment experiment_at(const Cell& cell, std::size_t mover, double time_s, const Occlusion& occlusion,
                             const TrialView& view) {
  const std::vector<std::vector<RigidMotion>> poses = {poses_at(cell, time_s)};
  const std::vector<Target>& targets = cell.movers[mover].body.targets;
  MotionVisibility visibility =
      visible_targets(targets, std::span(&poses.front()[mover], 1), cell.rig, cell.volume, view.visibility);
  if (!occlusion.empty()) visibility = common(visibility, occlusion.unhidden_targets(targets, mover, poses));
  return {cell, mover, time_s, visibility.seen.front(), view.noise};
}

}  // namespace

Cell with_targets(Cell cell, std::size_t mover, std::span<const Target> targets) {
  cell.movers[mover].body.targets.assign(targets.begin(), targets.end());
  return cell;
}

Cell standing_still(Cell cell, double time_s) {
  for (Mover& mover : cell.movers) {
    const auto* sweep = std::get_if<Sweep>(&mover.motion);
    mover.motion = at_rest(sweep != nullptr ? sweep->tracker_from_rest : pose_at(mover.motion, time_s));
  }
  return cell;
}

LayoutTrial trial_of(const Cell& cell, const VerifiedBody& body, const std::string& name,
                     std::span<const Target> targets, const Occlusion& occlusion, const TrialView& view) {
  const Cell moving = with_targets(cell, body.mover, targets);
  LayoutTrial trial{
      name, experiment_at(standing_still(moving), body.mover, 0, occlusion, view), {}, body.points};
  for (const double time_s : view.times_s)
    trial.moments.push_back(experiment_at(moving, body.mover, time_s, occlusion, view));
  trial.points[VerifiedBody::kCentroid].in_body_mm = centroid_of(positions_of(targets));
  return trial;
}

}  // namespace asterism
