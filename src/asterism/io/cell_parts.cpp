// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_parts.hpp"

#include <cmath>

namespace asterism {

RigidMotion plain_pose(const CellSection& section) {
  section.must_be(forms::pose_in_body());
  return pose_of_numbers(section);
}

RigidMotion pose_of_numbers(const CellSection& section) {
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

Shape shape_of(const CellSection& section, const Form& with) {
  const std::string kind = section.word("shape", words_of(forms::shapes(), "shape"));
  section.must_be(form_of(forms::shaped(with), "shape", kind));
  if (kind == "box") return Box{section.vector("size_mm")};
  if (kind == "capsule") {
    return Capsule{section.vector("from_mm"), section.vector("to_mm"), section.number("radius_mm")};
  }
  return Frustum{section.number("bottom_radius_mm"), section.number("top_radius_mm"),
                 section.number("height_mm")};
}

}  // namespace asterism
