// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// What a cubic needs at one key: speeds of the translation (mm/s, along the tracker's axes) and of the
/// rotation (rad/s, along the body's axes).
struct Velocity {
  Vec3 translation, rotation;
};

Velocity between(const KeyPose& from, const KeyPose& to) {
  const double step = to.time_s - from.time_s;
  const RigidMotion& a = from.tracker_from_body;
  const RigidMotion& b = to.tracker_from_body;
  return {(b.translation - a.translation) / step, log_rotation(a.rotation.conjugate() * b.rotation) / step};
}

/// Velocity of the parabola through a key and its two neighbours; at an end, of the only interval.
Velocity velocity_at(const std::vector<KeyPose>& keys, std::size_t i) {
  if (i == 0) return between(keys[0], keys[1]);
  if (i + 1 == keys.size()) return between(keys[i - 1], keys[i]);
  const Velocity before = between(keys[i - 1], keys[i]);
  const Velocity after = between(keys[i], keys[i + 1]);
  const double h0 = keys[i].time_s - keys[i - 1].time_s;
  const double h1 = keys[i + 1].time_s - keys[i].time_s;
  const double w0 = h1 / (h0 + h1);
  const double w1 = h0 / (h0 + h1);
  return {w0 * before.translation + w1 * after.translation, w0 * before.rotation + w1 * after.rotation};
}

/// The cubic with values 0 and `end`, and slopes `slope0` and `slope1` per unit of s.
Vec3 hermite(const Vec3& end, const Vec3& slope0, const Vec3& slope1, double s) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  return (s3 - 2 * s2 + s) * slope0 + (3 * s2 - 2 * s3) * end + (s3 - s2) * slope1;
}

RigidMotion pose_of(const KeyedMotion& motion, double time_s) {
  const auto& keys = motion.keys;
  require(!keys.empty(), "a keyed motion has at least one key");
  if (keys.size() == 1 || time_s <= keys.front().time_s) return keys.front().tracker_from_body;
  if (time_s >= keys.back().time_s) return keys.back().tracker_from_body;
  const auto next = std::upper_bound(keys.begin(), keys.end(), time_s,
                                     [](double t, const KeyPose& key) { return t < key.time_s; });
  const auto i = static_cast<std::size_t>(next - keys.begin()) - 1;
  const RigidMotion& a = keys[i].tracker_from_body;
  const RigidMotion& b = keys[i + 1].tracker_from_body;
  const double step = keys[i + 1].time_s - keys[i].time_s;
  const double s = (time_s - keys[i].time_s) / step;
  const Velocity v0 = velocity_at(keys, i);
  const Velocity v1 = velocity_at(keys, i + 1);

  const Vec3 turn = log_rotation(a.rotation.conjugate() * b.rotation);
  // Body rates are J(−φ) φ̇, so the slope at the end is read back through that Jacobian.
  const Vec3 turn_slope1 = left_jacobian(-turn).inverse() * v1.rotation;
  const Vec3 phi = hermite(turn, step * v0.rotation, step * turn_slope1, s);
  const Vec3 shift = hermite(b.translation - a.translation, step * v0.translation, step * v1.translation, s);
  return {(a.rotation * exp_rotation(phi)).normalized(), a.translation + shift};
}

/// Of the two, Rx Ry Rz is the inverse of Rz(−yaw) Ry(−pitch) Rx(−roll).
Quaternion turn_of(const Sweep& sweep, double time_s) {
  const double yaw = sweep.yaw.at(time_s), pitch = sweep.pitch.at(time_s), roll = sweep.roll.at(time_s);
  if (sweep.order == TurnOrder::YawPitchRoll) return rotation_from_yaw_pitch_roll(yaw, pitch, roll);
  return rotation_from_yaw_pitch_roll(-yaw, -pitch, -roll).conjugate();
}

RigidMotion pose_of(const Sweep& sweep, double time_s) {
  const bool before = sweep.from_s && time_s < *sweep.from_s;
  const bool after = sweep.to_s && time_s > *sweep.to_s;
  if (before || after) return sweep.tracker_from_rest;
  const Quaternion turn = turn_of(sweep, time_s);
  RigidMotion rest_from_body = rotation_about(sweep.pivot_mm, turn);
  rest_from_body.translation += Vec3(sweep.x.at(time_s), sweep.y.at(time_s), sweep.z.at(time_s));
  return sweep.tracker_from_rest * rest_from_body;
}

}  // namespace

double Swing::at(double time_s) const {
  return amplitude * std::sin(2.0 * std::numbers::pi * frequency_hz * time_s + phase_rad);
}

RigidMotion pose_at(const Motion& motion, double time_s) {
  return std::visit([&](const auto& kind) { return pose_of(kind, time_s); }, motion);
}

std::vector<RigidMotion> poses_between(const Motion& motion, double from_s, double to_s, int count) {
  require(count > 0, "a motion is looked at at least once");
  std::vector<RigidMotion> poses;
  for (int i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / (count - 1) : 0.0;
    poses.push_back(pose_at(motion, from_s + share * (to_s - from_s)));
  }
  return poses;
}

Motion at_rest(const RigidMotion& tracker_from_body) { return KeyedMotion{{{0.0, tracker_from_body}}}; }

}  // namespace asterism
