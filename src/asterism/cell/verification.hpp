// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/cell/layout_task.hpp"
#include "asterism/core/options.hpp"

namespace asterism {

/// What the cell must hold, and where: points of the part in the frame of the body that carries the targets.
struct Verification {
  std::string body;               // whose pose counts; empty = the platform's, else the first body
  double tolerance_mm = 0.25;     // largest error allowed at a point: the paper's (Section 4.3)
  double nominal_mm = 0.025;      // the tracker's nominal accuracy, told beside it
  std::vector<WorkPoint> points;  // none: the layout task's; none there either: corners of the part's box
};
/// All but its points.
void describe(Verification& verification, OptionVisitor& visit);

}  // namespace asterism
