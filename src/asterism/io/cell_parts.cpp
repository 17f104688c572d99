// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_parts.hpp"

#include <cmath>

namespace asterism {

using namespace cell_keys;

Keys both(Keys first, const Keys& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

RigidMotion plain_pose(const CellSection& section) {
  RigidMotion pose;
  pose.translation = section.vector_or_zero("position_mm");
  if (section.has("yaw_pitch_roll_deg")) {
    const Vec3 deg = section.vector("yaw_pitch_roll_deg");
    pose.rotation =
        rotation_from_yaw_pitch_roll(rad_from_deg(deg(0)), rad_from_deg(deg(1)), rad_from_deg(deg(2)));
  }
  if (section.has("quaternion_wxyz")) {
    if (section.has("yaw_pitch_roll_deg"))
      section.refuse("a pose has either angles or a quaternion, not both");
    const auto q = section.numbers("quaternion_wxyz", 4);
    pose.rotation = Quaternion(q[0], q[1], q[2], q[3]);
    if (!(std::abs(pose.rotation.norm() - 1) < 1e-3)) section.refuse("`quaternion_wxyz` must have length 1");
    pose.rotation.normalize();
  }
  return pose;
}

Shape shape_of(const CellSection& section, const cell_keys::Keys& beside) {
  const std::string kind = section.word("shape", kShapes);
  if (kind == "box") {
    section.only(both(beside, kBox));
    return Box{section.vector("size_mm")};
  }
  if (kind == "capsule") {
    section.only(both(beside, kCapsule));
    return Capsule{section.vector("from_mm"), section.vector("to_mm"), section.number("radius_mm")};
  }
  section.only(both(beside, kFrustum));
  return Frustum{section.number("bottom_radius_mm"), section.number("top_radius_mm"),
                 section.number("height_mm")};
}

}  // namespace asterism
