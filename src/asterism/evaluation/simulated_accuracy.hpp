// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/evaluation/disturbed_cell.hpp"
#include "asterism/simulation/simulate.hpp"
#include "asterism/tracking/tracker.hpp"

namespace asterism {

/// One body in one frame: simulated, tracked, compared.
struct SimulatedPose {
  PoseStatus status = PoseStatus::Lost;
  int targets = 0;                 // that took part
  RigidMotion truth;               // when the pose is used
  std::optional<Vec6> error;       // what takes the measured pose to the truth; none: no pose
  std::optional<Mat6> covariance;  // as the tracker stated it
  Mat6 systematic = Mat6::Zero();  // the share of it that frames have in common
  bool wrong = false;              // not merely noisy
};

struct SimulatedRunOptions {
  SimulationOptions simulation;
  TrackerOptions tracker;
  double wrong_mm = 2;     // at the targets' centroid: farther off than this, or
  double wrong_deg = 0.5;  // turned further, a pose is wrong
};

/// The cell's frames, made once and given to one tracker for each belief; by belief, then frame: the body of
/// mover `body`.
[[nodiscard]] std::vector<std::vector<SimulatedPose>> simulate_and_track(const Cell& cell,
                                                                         std::span<const Belief> beliefs,
                                                                         std::size_t body,
                                                                         const SimulatedRunOptions& options,
                                                                         const Progress& progress);

/// How many frames came to each status, in the order of PoseStatus.
[[nodiscard]] std::array<std::size_t, 5> status_counts(std::span<const SimulatedPose> poses);

/// The error at a point of the body, along the tracker's axes, mm.
[[nodiscard]] Vec3 error_at(const SimulatedPose& pose, const Vec3& in_body);

}  // namespace asterism
