// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "asterism/core/options.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// A triangulating scanner that is tracked by the targets on its housing. Its frame: origin between
/// projector and camera, z towards the part. Table 8 of the paper: best at 300 mm, 350 × 310 mm wide there.
struct Scanner {
  std::string body = "scanner";
  RigidMotion body_from_scanner;
  double stand_off_mm = 300;
  double near_mm = 200, far_mm = 400;
  double field_width_mm = 350, field_height_mm = 310;  // at the stand-off
  double max_incidence_deg = 60;
};
/// All but its pose.
void describe(Scanner& scanner, OptionVisitor& visit);

}  // namespace asterism
