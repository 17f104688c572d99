// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/core/options.hpp"
#include "asterism/simulation/simulate.hpp"

// What is done to a cell to see whether its tracker bears it.

namespace asterism {

struct RobustnessOptions {
  std::uint64_t seed = 1;
  int frames = 24;       // of each run at the level of centres
  int repeats = 4;       // runs of a fault that has no variants of its own
  int image_frames = 8;  // of each run on images; 0 = none
  double loss = 0.05;    // share of targets missed at random
  double lost_frames = 0.2;
  double wrong_mm = 2;  // a pose farther off at any named point, or in rotation, is wrong
  double wrong_deg = 0.5;
};
void describe(RobustnessOptions& options, OptionVisitor& visit);

/// One run of a cell with one thing wrong.
struct FaultRun {
  std::string fault;    // "one target lost": runs of the same fault make one row
  std::string variant;  // "P3 + P5"; empty when there is but one
  Cell cell;            // as it truly is: the fault in it, its targets off their map
  SimulationOptions simulation;
  int first_frame = 0, frames = 0;
  std::optional<int> knocked;    // the target (index) that stands elsewhere than the body's file says,
  Vec3 shift_mm = Vec3::Zero();  // by so much, in the body's frame
};

/// The body whose pose counts (index into the movers), as verification_of(cell) has it. Throws InputError
/// when it is not there.
[[nodiscard]] std::size_t verified_body(const Cell& cell);

/// Where errors are told, in the frame of the verified body: the verification's points, else the layout
/// task's, else the middle of the targets.
[[nodiscard]] std::vector<Vec3> points_in_question(const Cell& cell);

/// What the tracker is told: the bodies of the cell, each target with the covariance that it states or
/// that the noise model's `map_sigma_mm` gives it.
[[nodiscard]] std::vector<Body> bodies_as_learnt(const Cell& cell);

/// Nothing wrong; each target, and each pair of targets, lost; targets missed at random; each target
/// knocked by 0.2, 1 and 5 mm (the direction drawn); false centres; lost frames; the cell's second body
/// crossing before the first; and on images backlight, a lamp beside a target, glints and a part that
/// shines. Runs start at different moments of the motion. In each the targets stand off their map by a
/// draw of their own.
[[nodiscard]] std::vector<FaultRun> fault_runs(const Cell& cell, const RobustnessOptions& options);

}  // namespace asterism
