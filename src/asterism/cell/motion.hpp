// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// amplitude · sin(2π frequency t + phase); the amplitude in the unit of what swings (rad or mm).
struct Swing {
  double amplitude = 0;
  double frequency_hz = 0;
  double phase_rad = 0;

  [[nodiscard]] double at(double time_s) const;
};

/// Which axis of a platform is carried by which: Rz(yaw) Ry(pitch) Rx(roll), or Rx(roll) Ry(pitch) Rz(yaw).
enum class TurnOrder { YawPitchRoll, RollPitchYaw };

/// To and fro about a place of rest: turned about a pivot of the body, and along the body's axes at rest.
/// The paper's platform sweeps ±15° this way.
struct Sweep {
  RigidMotion tracker_from_rest;
  Vec3 pivot_mm = Vec3::Zero();  // in the body's frame
  Swing yaw, pitch, roll;        // rad
  Swing x, y, z;                 // mm
  TurnOrder order = TurnOrder::YawPitchRoll;
  std::optional<double> from_s, to_s;  // at rest before and after
};

struct KeyPose {
  double time_s = 0;
  RigidMotion tracker_from_body;
};

/// Through given poses, smoothly: cubic Hermite in translation and, within each interval, in the rotation
/// vector from its first key. Position and velocity are continuous, and each key is met. Before the first
/// and after the last key the body stands still; one key alone is a body at rest. Poses recorded from a
/// real run are keys too.
struct KeyedMotion {
  std::vector<KeyPose> keys;  // times strictly increasing, at least one
};

using Motion = std::variant<KeyedMotion, Sweep>;

/// tracker_from_body at a moment.
[[nodiscard]] RigidMotion pose_at(const Motion& motion, double time_s);

/// `count` poses evenly in time, the first and the last moment among them (one alone: the first).
[[nodiscard]] std::vector<RigidMotion> poses_between(const Motion& motion, double from_s, double to_s,
                                                     int count);

/// A body that stands still.
[[nodiscard]] Motion at_rest(const RigidMotion& tracker_from_body);

}  // namespace asterism
