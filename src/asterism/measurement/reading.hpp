// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// What a platform says of its own pose: where the body it turns is in the frame that its axes are told in
/// (`base`, fixed to the ground). Nobody needs to know where that frame is; the tracker's poses tell it.
struct PlatformReading {
  double time_s = 0;  // its stamp; it tells of where the platform was one latency earlier
  RigidMotion base_from_body;
  Mat6 covariance = Mat6::Zero();  // ω (rad), δ (mm) at the body's origin, along the base's axes
  /// The share of it that keeps its value from reading to reading (for the read-out's correlation time):
  /// averaging over a few readings does not make it smaller.
  Mat6 correlated = Mat6::Zero();
};

}  // namespace asterism
