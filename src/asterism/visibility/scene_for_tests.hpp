// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/cell/paper_layouts.hpp"

// The paper's layouts, and a cell to see them from.

namespace asterism::scene {

using Layout = std::vector<Vec3>;

inline const std::vector<Layout> kTable1 = places_of(paper_table1());
inline const std::vector<Layout> kTable9 = places_of(paper_table9());

/// Discs of 12 mm that face up, tilted outwards by 0.3.
inline std::vector<Target> targets_of(const Layout& layout) {
  std::vector<Target> targets;
  for (const Vec3& at : layout) {
    Target target;
    target.id = "P" + std::to_string(targets.size() + 1);
    target.position = at;
    target.normal = Vec3(0.3 * at.x() / at.norm(), 0.3 * at.y() / at.norm(), 0.9).normalized();
    target.diameter_mm = 12;
    targets.push_back(target);
  }
  return targets;
}

/// Two cameras 1 m apart with distortion of every kind.
inline StereoRig rig() {
  StereoRig rig = rig_of(CameraPair{});
  rig.left.distortion = {-0.12, 0.08, 3e-4,  -2e-4, -0.02, 0.01, 0.02,
                         0.003, 1e-4, -2e-4, 2e-4,  1e-4,  0.01, -0.02};
  rig.left.coefficients = 14;
  rig.right.distortion = {-0.11, 0.07, -2e-4, 3e-4, -0.01};
  rig.right.coefficients = 5;
  return rig;
}

/// A platform that swings before them by up to 15 degrees about each axis, seen from 60 degrees above.
inline std::vector<RigidMotion> motion(const StereoRig& rig, int poses) {
  Sweep sweep;
  sweep.tracker_from_rest = tracker_from_frame({{0, 0, 600}, 2300, rad_from_deg(60), rad_from_deg(45)}, rig);
  sweep.yaw = {rad_from_deg(15), 0.17, 0};
  sweep.pitch = {rad_from_deg(15), 0.23, 0.7};
  sweep.roll = {rad_from_deg(15), 0.29, 1.9};
  return poses_between(sweep, 0, 12, poses);
}

}  // namespace asterism::scene
