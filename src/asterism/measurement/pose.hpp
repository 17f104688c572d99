// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// Ok: four or more targets seen by both cameras. Partial: fewer, yet the pose is fully determined.
/// Predicted: not measured in this frame, carried on by the filter. Ambiguous: another labelling fits
/// as well. Lost: not found. The last two come without a pose: what is not trusted is not shown.
enum class PoseStatus { Ok, Partial, Predicted, Ambiguous, Lost };

[[nodiscard]] std::string_view text_of(PoseStatus status);
/// Throws InputError for an unknown word.
[[nodiscard]] PoseStatus status_of_text(std::string_view text);

struct PoseEstimate {
  RigidMotion tracker_from_body;
  Mat6 covariance = Mat6::Zero();  // ω (rad), δ (mm) at the body's origin, along the tracker's axes
  /// The share of it that is the same in each frame (the body's and the rig's own error): averaging
  /// over frames does not make it smaller.
  Mat6 systematic = Mat6::Zero();
};

/// One body in one frame.
struct BodyPose {
  int body = 0;  // index into the bodies
  PoseStatus status = PoseStatus::Lost;
  std::optional<PoseEstimate> estimate;  // present for Ok, Partial, Predicted
  int targets = 0;                       // how many took part
  double rms_px = 0;                     // of their residuals
  std::vector<int> rejected = {};        // targets that were seen and did not fit; ascending
};

/// One body's pose at one moment of a run.
struct TimedPose {
  double time_s = 0;
  BodyPose pose;
};

}  // namespace asterism
