// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/evaluation/disturbance_runs.hpp"
#include "asterism/evaluation/verified_body.hpp"
#include "asterism/visibility/occlusion.hpp"

namespace asterism {

/// The cell with these targets on one of its bodies.
[[nodiscard]] Cell with_targets(Cell cell, std::size_t mover, std::span<const Target> targets);

/// The cell as it stands still: each body where its sweep rests, or where it is at `time_s`.
[[nodiscard]] Cell standing_still(Cell cell, double time_s = 0);

/// How a trial is looked at.
struct TrialView {
  std::span<const double> times_s;
  VisibilityOptions visibility;
  AccuracyOptions noise;  // of the centres
};

/// The layout made ready to be disturbed: what each camera sees of it at rest and at each moment. `occlusion`
/// is the cell's, whose solids do not depend on the targets. Moments at which too little is seen are there
/// too and give no pose.
[[nodiscard]] LayoutTrial trial_of(const Cell& cell, const VerifiedBody& body, const std::string& name,
                                   std::span<const Target> targets, const Occlusion& occlusion,
                                   const TrialView& view);

}  // namespace asterism
