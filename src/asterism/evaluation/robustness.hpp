// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/evaluation/faults.hpp"
#include "asterism/tracking/tracker.hpp"

namespace asterism {

/// What became of one body's frames. Each frame is one of: kept, rough, flagged, lost, too sure, wrong.
struct Outcome {
  std::size_t frames = 0;
  std::size_t kept = 0;      // OK or PARTIAL, and right
  std::size_t rough = 0;     // the same but farther off than the gate, as its covariance says it may be
  std::size_t flagged = 0;   // AMBIGUOUS or PREDICTED: the tracker says that it did not measure
  std::size_t lost = 0;      // LOST
  std::size_t blind = 0;     // of the lost, frames with fewer than four targets seen by both cameras
  std::size_t too_sure = 0;  // right, but farther off than its covariance lets one think (1 in 10⁶)
  std::size_t wrong = 0;     // both: silently wrong
  std::size_t seen = 0;      // OK or PARTIAL; of these
  double square_mm = 0;      // sum of the squared errors at the worst point
  double max_mm = 0;
  std::size_t poses = 0;      // PREDICTED too; of these
  double nees = 0;            // sum of eᵀ C⁻¹ e
  std::size_t inside_95 = 0;  // errors inside their own 95 % ellipsoid

  Outcome& operator+=(const Outcome& other);
  [[nodiscard]] double rms_mm() const;
  [[nodiscard]] double nees_share() const;  // mean of eᵀ C⁻¹ e / 6; 1 is honest
  [[nodiscard]] double inside_95_share() const;
};

/// What a cell shows of a body in a frame, whatever the tracker makes of it.
struct Shown {
  RigidMotion tracker_from_body;
  bool enough = false;  // four targets seen by both cameras
};
/// Whole and bright enough for simulation to make a centre of it.
[[nodiscard]] bool is_seen(const TargetTruth& target);
[[nodiscard]] Shown shown_in(const SimulatedFrame& frame, std::size_t body);

/// Counts one pose of that body; errors are told at the worst of `points` (in its frame).
void count_frame(const BodyPose& pose, const Shown& shown, std::span<const Vec3> points,
                 const RobustnessOptions& options, Outcome& outcome);

/// One fault, summed over its runs.
struct FaultOutcome {
  std::string fault;
  std::size_t runs = 0;
  Outcome measured, filtered;
  std::string worst;  // the variant of most wrong, then most lost frames; empty when all were kept
  // Targets refused frame by frame:
  std::size_t named = 0;        // frames in which the knocked target, and no other, was refused
  std::size_t named_wrong = 0;  // frames in which another was
  // Targets accused of having moved, from all frames of a run (tracking/knocked_targets.hpp):
  std::size_t knocks = 0;         // runs with a knocked target
  std::size_t found = 0;          // of these, runs in which it was accused, it alone and without a rival
  std::size_t undecided = 0;      // of these, runs in which it or a rival
  std::size_t accused_wrong = 0;  // runs in which another was
  double shift_chi_square = 0;    // of the told shifts against the true ones, summed over `found`; 3 each
  // The smallest knock of any one target that would be found, from all frames of a run and from one frame
  // alone: medians over runs and targets.
  double detectable_mm = 0, detectable_at_once_mm = 0;
};

struct RobustnessTable {
  std::vector<FaultOutcome> rows;
  RobustnessOptions options;
  [[nodiscard]] std::size_t wrong() const;     // over all rows, measured and filtered
  [[nodiscard]] std::size_t too_sure() const;  // likewise
};

/// Simulates each fault, tracks it and compares with the truth.
[[nodiscard]] RobustnessTable robustness_of(const Cell& cell, const RobustnessOptions& options,
                                            const TrackerOptions& tracker, const Progress& progress);

}  // namespace asterism
