// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/simulated_accuracy.hpp"

#include <algorithm>

#include "asterism/core/parallel.hpp"
#include "asterism/geometry/point_sets.hpp"

namespace asterism {
namespace {

constexpr std::size_t kTogether = 16;  // frames made at once: images are large

SimulatedPose compared(const BodyPose& pose, const RigidMotion& truth, const Vec3& centroid,
                       const SimulatedRunOptions& options) {
  SimulatedPose compared;
  compared.status = pose.status;
  compared.targets = pose.targets;
  compared.truth = truth;
  if (!pose.estimate) return compared;
  const RigidMotion& measured = pose.estimate->tracker_from_body;
  compared.error = difference(truth, measured);
  compared.covariance = pose.estimate->covariance;
  compared.systematic = pose.estimate->systematic;
  compared.wrong = (truth * centroid - measured * centroid).norm() > options.wrong_mm ||
                   deg_from_rad(rotation_angle(truth.rotation, measured.rotation)) > options.wrong_deg;
  return compared;
}

}  // namespace

std::vector<std::vector<SimulatedPose>> simulate_and_track(const Cell& cell, std::span<const Belief> beliefs,
                                                           std::size_t body,
                                                           const SimulatedRunOptions& options,
                                                           const Progress& progress) {
  const Simulator simulator(cell, options.simulation);
  std::vector<Tracker> trackers;
  for (const Belief& belief : beliefs) trackers.emplace_back(belief.rig, belief.bodies, options.tracker);
  const Mover& mover = cell.movers[body];
  const Vec3 centroid = centroid_of(positions_of(mover.body.targets));
  const auto frames = static_cast<std::size_t>(cell.timing.frames);
  std::vector<std::vector<SimulatedPose>> poses(beliefs.size());
  for (std::size_t first = 0; first < frames; first += kTogether) {
    std::vector<SimulatedFrame> made(std::min(kTogether, frames - first));
    parallel_for(made.size(), [&](std::size_t i) { made[i] = simulator.frame(static_cast<int>(first + i)); });
    parallel_for(trackers.size(), [&](std::size_t i) {
      for (const SimulatedFrame& frame : made) {
        const TrackedFrame tracked = options.simulation.level == SimulationLevel::Images
                                         ? trackers[i].process(frame.image)
                                         : trackers[i].process(frame.centres);
        const RigidMotion truth = pose_at(mover.motion, frame.time_s + beliefs[i].latency_s);
        poses[i].push_back(compared(tracked.poses[body], truth, centroid, options));
      }
    });
    progress("simulating and tracking", first + made.size(), frames);
  }
  return poses;
}

std::array<std::size_t, 5> status_counts(std::span<const SimulatedPose> poses) {
  std::array<std::size_t, 5> counts{};
  for (const SimulatedPose& pose : poses) ++counts[static_cast<std::size_t>(pose.status)];
  return counts;
}

Vec3 error_at(const SimulatedPose& pose, const Vec3& in_body) {
  require(pose.error.has_value(), "only a pose has an error");
  return pose.error->tail<3>() + pose.error->head<3>().cross(pose.truth.rotation * in_body);
}

}  // namespace asterism
