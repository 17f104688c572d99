// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

// Every key of a cell file, in one place. Those of [sensor], [light], [timing], of a camera pair, of
// [tracker.volume] and of [layout] are the options that cell/ describes.

namespace asterism::cell_keys {

using Keys = std::vector<std::string>;

inline const Keys kRoot = {"name", "tracker", "body", "obstacle", "sensor", "light", "timing", "layout"};
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
inline const Keys kVolume = {"volume"};
/// Beside the options that cell/layout_task.hpp describes.
inline const Keys kLayoutLists = {"patch", "keep_out", "point"};
inline const Keys kPatch = {"name", "kind"};
inline const Keys kCylinderSide = {"base_mm", "radius_mm", "height_mm", "from_deg", "to_deg"};
inline const Keys kAnnulus = {"centre_mm", "inner_radius_mm", "outer_radius_mm", "from_deg", "to_deg"};
inline const Keys kPlate = {"pose", "width_mm", "height_mm"};
inline const Keys kCylinderRoom = {"base_mm", "radius_mm", "height_mm", "tilt_deg"};
inline const Keys kKeepOut = {"name", "shape", "pose"};
inline const Keys kPoseInBody = {"position_mm", "yaw_pitch_roll_deg", "quaternion_wxyz"};
inline const Keys kPoint = {"name", "position_mm"};
inline const Keys kPatches = {"cylinder-side", "annulus", "plate", "cylinder-room"};
inline const Keys kMotions = {"rest", "sweep", "keys", "recorded"};
inline const Keys kShapes = {"box", "capsule", "frustum"};

}  // namespace asterism::cell_keys
