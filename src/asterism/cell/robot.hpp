// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/cell/shape.hpp"
#include "asterism/core/options.hpp"

namespace asterism {

/// A turning joint of an arm: where it sits on the link before it, its axis, how far it goes, and the link it
/// carries as a capsule.
struct RobotJoint {
  RigidMotion parent_from_joint;  // at angle 0
  Vec3 axis = Vec3::UnitZ();      // unit, in the joint's frame
  double lowest_deg = -180, highest_deg = 180;
  Capsule link;  // in the joint's frame, moves with it
};
/// The limits only.
void describe(RobotJoint& joint, OptionVisitor& visit);

/// An arm that carries the scanner's body: a chain of turning joints from its base.
struct Robot {
  RigidMotion tracker_from_base;
  std::vector<RobotJoint> joints;        // from the base on
  RigidMotion flange_from_scanner_body;  // flange = the last joint's frame
};

}  // namespace asterism
