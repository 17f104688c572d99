// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/core/lanes.hpp"

namespace asterism {

/// The same motion of a body for four poses at a time: rotation by rows, translation (mm).
struct alignas(kLanesAlignment) MotionLanes {
  std::array<std::array<DoubleLanes, 3>, 3> rotation;
  std::array<DoubleLanes, 3> translation;
};

/// Poses of a body as each camera sees them, four in a vector, made once and asked for many layouts of
/// targets. The last pose fills up the last vector.
struct SeenMotion {
  StereoRig rig;
  std::vector<RigidMotion> tracker_from_body;
  std::array<std::vector<MotionLanes>, 2> camera_from_body;  // by side

  [[nodiscard]] std::size_t poses() const { return tracker_from_body.size(); }
};

[[nodiscard]] SeenMotion seen_motion(std::span<const RigidMotion> tracker_from_body, const StereoRig& rig);

}  // namespace asterism
