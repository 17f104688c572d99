// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/seen_motion.hpp"

#include <algorithm>

namespace asterism {

SeenMotion seen_motion(std::span<const RigidMotion> tracker_from_body, const StereoRig& rig) {
  SeenMotion motion{rig, {tracker_from_body.begin(), tracker_from_body.end()}, {}};
  const std::size_t poses = tracker_from_body.size();
  for (const Side side : {Side::Left, Side::Right}) {
    auto& lanes = motion.camera_from_body[static_cast<std::size_t>(side)];
    lanes.resize((poses + kDoubleLanes - 1) / kDoubleLanes);
    const RigidMotion camera_from_tracker = rig.camera_from_tracker(side);
    for (std::size_t slot = 0; slot < lanes.size() * kDoubleLanes; ++slot) {
      const RigidMotion pose = camera_from_tracker * tracker_from_body[std::min(slot, poses - 1)];
      const Mat3 rotation = pose.rotation.toRotationMatrix();
      MotionLanes& block = lanes[slot / kDoubleLanes];
      const std::size_t lane = slot % kDoubleLanes;
      for (int row = 0; row < 3; ++row) {
        const auto r = static_cast<std::size_t>(row);
        for (int column = 0; column < 3; ++column) {
          block.rotation[r][static_cast<std::size_t>(column)][lane] = rotation(row, column);
        }
        block.translation[r][lane] = pose.translation(row);
      }
    }
  }
  return motion;
}

}  // namespace asterism
