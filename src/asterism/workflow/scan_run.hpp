// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/cell/cell.hpp"
#include "asterism/core/options.hpp"
#include "asterism/scanning/scan_plan.hpp"

namespace asterism {

/// How a plan is carried out.
struct ScanRunOptions {
  double view_s = 0;    // each view is measured so long; 0 = as the cell's scan task says
  double pace = 1;      // moves, turns and rests are so many times shorter than the scan task says
  double sway_deg = 0;  // the platform yaws by so much to either side while a view is measured; 0 = it rests
  int first_scan = 1;   // number of the first view's scan
};
void describe(ScanRunOptions& options, OptionVisitor& visit);

/// The cell in motion that carries a plan out. The platform begins at rest and turns to each view's pose
/// (never faster than its stroke allows); the scanner draws back along its line of sight, goes around the
/// part and comes to the next view, in the plan's order; where it stands still, a ScanPass measures. Around
/// each pass all is at rest for two frames more, or sways on steadily, so that poses between frames can be
/// told there. The frames last until the end of the tour. The way between views is simple and not planned: it
/// may lead through obstacles. Throws InputError for a cell without scanner or workpiece, and for a plan
/// without views.
[[nodiscard]] Cell scan_run(Cell cell, const ScanPlan& plan, const ScanRunOptions& options);

}  // namespace asterism
