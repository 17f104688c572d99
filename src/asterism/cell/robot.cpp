// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/robot.hpp"

namespace asterism {

void describe(RobotJoint& joint, OptionVisitor& visit) {
  visit.number("lowest_deg", joint.lowest_deg, {-720, 720}, "smallest angle");
  visit.number("highest_deg", joint.highest_deg, {-720, 720}, "largest angle");
}

}  // namespace asterism
