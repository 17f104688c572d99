// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/evaluation/layout_trial.hpp"
#include "asterism/evaluation/predicted_accuracy.hpp"
#include "asterism/simulation/test_cell.hpp"

// A cell whose every source of errors is at work, for tests of what verification makes of it.

namespace asterism::verification_scene {

inline Cell cell(int frames = 40) {
  Cell cell = test_cell();
  cell.timing = {frames, 20};
  cell.platform = Platform{};
  cell.noise.sigma_px = 0.05;
  cell.noise.map_sigma_mm = 0.02;
  cell.noise.focal_sigma_px = 0.1;
  cell.noise.principal_sigma_px = 0.1;
  cell.noise.turn_sigma_deg = 0.001;
  cell.noise.baseline_sigma_mm = 0.02;
  cell.verification.points = {{"tip", Vec3(400, 0, 900)}, {"foot", Vec3(0, 300, 100)}};
  return cell;
}

/// All targets are seen by both cameras.
inline std::array<TargetMask, 2> all_seen(const Cell& cell) {
  const TargetMask all = (TargetMask{1} << cell.movers[0].body.targets.size()) - 1;
  return {all, all};
}

inline PoseExperiment experiment(const Cell& cell, double time_s = 0.3) {
  return {cell, 0, time_s, all_seen(cell), accuracy_options_of(cell, CentreLevel::Centres)};
}

inline std::vector<double> frame_times(const Cell& cell) {
  std::vector<double> times;
  for (int i = 0; i < cell.timing.frames; ++i) times.push_back(i / cell.timing.rate_hz);
  return times;
}

inline std::vector<RigidMotion> poses(const Cell& cell) {
  std::vector<RigidMotion> poses;
  for (const double time_s : frame_times(cell)) poses.push_back(pose_at(cell.movers[0].motion, time_s));
  return poses;
}

inline MotionVisibility visibility(const Cell& cell) {
  return visible_targets(cell.movers[0].body.targets, poses(cell), cell.rig, cell.volume, {});
}

inline LayoutTrial trial(const Cell& cell, const std::string& name, const std::vector<Target>& targets) {
  const std::vector<double> times = {0, 0.5, 1, 1.5};
  const TrialView view{times, {}, accuracy_options_of(cell, CentreLevel::Centres)};
  return trial_of(cell, verification_of(cell), name, targets, Occlusion(cell), view);
}

/// The body's targets, drawn together or apart about their middle.
inline std::vector<Target> scaled_targets(const Cell& cell, double factor) {
  std::vector<Target> targets = cell.movers[0].body.targets;
  for (Target& target : targets) {
    target.position.x() *= factor;
    target.position.y() *= factor;
  }
  return targets;
}

}  // namespace asterism::verification_scene
