// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

// Every key of a cell file, in one place. Those of [sensor], [light], [timing] and of a camera pair are
// the options that cell/cell.hpp describes.

namespace asterism::cell_keys {

using Keys = std::vector<std::string>;

inline const Keys kRoot = {"name", "tracker", "body", "obstacle", "sensor", "light", "timing"};
inline const Keys kRigFile = {"rig"};
inline const Keys kLenses = {"left", "right", "right_from_left"};
inline const Keys kLens = {"width_px", "height_px", "fx", "fy", "skew", "cx", "cy", "distortion"};
inline const Keys kBody = {"name", "target", "motion"};
inline const Keys kTarget = {"id", "position_mm", "normal", "diameter_mm"};
inline const Keys kAtRest = {"kind", "pose"};
inline const Keys kSweep = {"kind", "pose", "pivot_mm", "yaw", "pitch", "roll", "x", "y", "z"};
inline const Keys kKeyed = {"kind", "key"};
inline const Keys kRecorded = {"kind", "file", "body"};
inline const Keys kKeyPose = {"time_s", "pose"};
inline const Keys kTurning = {"amplitude_deg", "frequency_hz", "phase_deg"};
inline const Keys kShifting = {"amplitude_mm", "frequency_hz", "phase_deg"};
/// `in` names a body given before: the pose is in its frame at rest. With `seen_at_mm` the frame is placed
/// so that the cameras look at that point of it.
inline const Keys kPose = {"in", "position_mm", "yaw_pitch_roll_deg", "quaternion_wxyz"};
inline const Keys kSeenPose = {"seen_at_mm", "range_mm", "elevation_deg", "azimuth_deg"};
inline const Keys kObstacle = {"name", "shape", "body", "pose", "level"};
inline const Keys kBox = {"size_mm"};
inline const Keys kCapsule = {"from_mm", "to_mm", "radius_mm"};
inline const Keys kFrustum = {"bottom_radius_mm", "top_radius_mm", "height_mm"};
inline const Keys kMotions = {"rest", "sweep", "keys", "recorded"};
inline const Keys kShapes = {"box", "capsule", "frustum"};

}  // namespace asterism::cell_keys
