// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "asterism/measurement/pose.hpp"

namespace asterism {

/// One row of a table of poses: what a file says of one body in one frame, be it measured or true.
struct PoseRecord {
  int frame = 0;
  double time_s = 0;
  std::string body;
  PoseStatus status = PoseStatus::Ok;
  std::optional<RigidMotion> tracker_from_body;  // absent for Ambiguous and Lost
  std::optional<Mat6> covariance;                // ω (rad), δ (mm); diagonal when only sigmas were given
  int targets = 0;
  double rms_px = 0;
  std::optional<Mat6> systematic = {};  // the covariance's share that is the same in each frame, where told
};

}  // namespace asterism
