// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/core/progress.hpp"
#include "asterism/tracking/fused_filter.hpp"
#include "asterism/tracking/tracker.hpp"

namespace asterism {

struct FusionOptions {
  double occlusion_s = 0.5;                         // the one that is drawn
  std::vector<double> others_s = {0.1, 0.2, 1, 2};  // the cost as a curve
  int runs = 20;                                    // of noise, one and the same for each occlusion
  std::uint64_t seed = 1;
  TrackerOptions tracker;
  bool suit_filter = true;  // both roads' wander from the motion itself (filter_suited_to), or the tracker's
  FusedOptions fused;       // latency and correlation are taken from the run and the cell
};
void describe(FusionOptions& options, OptionVisitor& visit);

/// How well a pose is known on one of the two roads, over all runs: at the point that suffers most.
struct FusionRoad {
  // While both cameras are blind:
  std::size_t frames = 0, lost = 0;  // moments of all runs; those without a pose
  double rms_mm = 0, p95_mm = 0;     // of the poses there are
  double stated_mm = 0;              // RMS of √tr Σ at the point: what the filter says of itself
  double nees = 0;                   // mean, six when the covariance holds; more: too sure, less: too modest
  double in_95_percent = 0;          // share of errors inside their own 95 % ellipsoid
  // In the half second after:
  double after_rms_mm = 0;
  double back_s = 0;  // mean time until the pose is measured again, from the first frame with sight
  /// By frame of the motion: RMS over the runs, and the band in which 95 % of them lie; NaN: no pose.
  std::vector<double> by_frame_mm, low_mm, high_mm;
};

struct FusionSpell {
  double occlusion_s = 0;
  double from_s = 0;  // the first blind frame
  FusionRoad alone, with_read_out;
};

/// The latency as each run told it, from the frames with sight alone.
struct FusionOffset {
  double true_s = 0;
  int told = 0;                     // runs that told it
  std::vector<std::string> untold;  // why the others did not, in words
  double mean_s = 0, sigma_s = 0;   // means over the runs: the estimate, and its stated σ
  double rms_in_sigma = 0;          // of the errors; 1 when the σ holds
  double base_nees = 0;             // mean over six, of where the base is; 1 when its covariance holds
};

/// What the platform's own read-out gains while both cameras are blind (the paper's Section 6): the platform
/// is simulated by its ReadOut (an assumption, printed as such), tracked with the cameras black for a while
/// in the middle of the motion, and filtered without and with what it says of itself.
struct FusionStudy {
  std::string body, point;  // the named point whose error is largest while blind
  Vec3 in_body_mm = Vec3::Zero();
  ReadOut read_out;
  FilterOptions filter;  // of both roads
  int runs = 0;
  std::vector<double> times_s;
  FusionSpell drawn;                // with its curves over time
  std::vector<FusionSpell> spells;  // all lengths that the motion has room for, shortest first; no curves
  FusionOffset offset;
};

/// The wander that who knows the motion would set: white acceleration that after `coast_s` leaves a pose as
/// uncertain as the motion's RMS acceleration a about one axis, unknown but constant, would: q = ¾ a²
/// coast_s. The rest as in `options`.
[[nodiscard]] FilterOptions filter_suited_to(const Motion& motion, double seconds, double coast_s,
                                             const FilterOptions& options);

/// `points` in the platform's frame, one at least. Throws InputError when the cell has no platform, or its
/// motion no room for an occlusion; MeasurementError when the tracker sees nothing before it.
[[nodiscard]] FusionStudy fusion_of(const Cell& cell, std::span<const WorkPoint> points,
                                    const FusionOptions& options, const Progress& progress);

}  // namespace asterism
