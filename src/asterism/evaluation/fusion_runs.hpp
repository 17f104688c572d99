// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "asterism/evaluation/fusion.hpp"
#include "asterism/simulation/simulate.hpp"

// The runs that fusion.cpp sums up.

namespace asterism {

/// The first blind frame and the first with sight again.
struct BlindFrames {
  std::size_t from = 0, to = 0;
};

/// One run's noise through one occlusion: a pose a frame on either road.
struct FusionRun {
  std::vector<BodyPose> alone, with_read_out;
};

/// All occlusions with one run's noise, and the latency as the first of them lets it be told.
struct FusionRuns {
  Result<TimeOffset, OffsetFailure> offset;
  std::vector<FusionRun> by_occlusion;
};

/// Made ready once for all runs.
class FusionBench {
 public:
  FusionBench(const Cell& cell, const FusionOptions& options);

  /// The noise of a run is the same in each occlusion.
  [[nodiscard]] FusionRuns run(int number, std::span<const BlindFrames> occlusions) const;

  [[nodiscard]] const FilterOptions& filter() const { return filter_; }
  [[nodiscard]] const std::vector<double>& times_s() const { return times_s_; }
  [[nodiscard]] const std::vector<RigidMotion>& truth() const { return truth_; }  // of the platform, by frame

 private:
  [[nodiscard]] std::vector<StereoCentres> centres(std::uint64_t seed) const;
  [[nodiscard]] std::vector<TimedPose> tracked(const std::vector<StereoCentres>& seen,
                                               const BlindFrames& blind) const;

  Cell cell_;
  FusionOptions options_;
  std::size_t mover_;
  FilterOptions filter_;
  Tracker tracker_;  // new
  std::vector<double> times_s_;
  std::vector<FrameTruth> frames_;
  std::vector<RigidMotion> truth_;
};

}  // namespace asterism
