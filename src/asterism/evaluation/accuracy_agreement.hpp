// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/evaluation/predicted_accuracy.hpp"
#include "asterism/evaluation/simulated_accuracy.hpp"
#include "asterism/statistics/intervals.hpp"

namespace asterism {

// Two roads to the same answer, held against each other: what was predicted of a motion, and what simulated,
// tracked and compared frames of it came to.

struct PointAgreement {
  std::string point;
  double simulated_mm = 0;  // RMS over the frames that have both
  double predicted_mm = 0;
  [[nodiscard]] double ratio() const { return simulated_mm / predicted_mm; }
};

/// Σ eᵀ C⁻¹ e of the pose's six errors against a covariance: 6 a pose when it is honest.
struct NeesAgreement {
  std::size_t poses = 0;
  double mean = 0;
  Interval band;  // of the mean, 95 %, where frames are independent
  [[nodiscard]] bool honest() const { return band.holds(mean); }
};

struct AccuracyAgreement {
  std::vector<PointAgreement> points;
  NeesAgreement predicted;                 // errors against the prediction
  NeesAgreement stated;                    // against what the tracker stated of itself
  std::vector<std::size_t> outside;        // frames whose mean over the repeats is outside the band that all
                                           // frames together leave with 5 % probability
  std::vector<std::size_t> unpredicted;    // frames with a pose in some repeat though none was predicted
  std::vector<std::size_t> missed;         // frames without a pose in some repeat though one was predicted
  std::size_t wrong = 0;                   // poses
  std::vector<std::size_t> other_targets;  // frames in which more or fewer targets took part than predicted
};

/// `repeats` are runs of the same motion with noise drawn anew, one pose a frame. `visibility` is the
/// prediction's. Wrong poses count in `wrong` alone.
[[nodiscard]] AccuracyAgreement compare_roads(const PredictedAccuracy& predicted,
                                              std::span<const std::vector<SimulatedPose>> repeats,
                                              const MotionVisibility& visibility);

}  // namespace asterism
