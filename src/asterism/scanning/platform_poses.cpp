// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/platform_poses.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// tracker_from_body where a body rests.
RigidMotion rest_of(const Motion& motion) {
  if (const auto* sweep = std::get_if<Sweep>(&motion)) return sweep->tracker_from_rest;
  return pose_at(motion, 0);
}

/// From −stroke to +stroke.
std::vector<double> angles(double stroke_deg, int steps) {
  std::vector<double> all = {0};
  for (int i = 1; stroke_deg > 0 && 2 * i < steps; ++i) {
    const double angle = stroke_deg * 2 * i / (steps - 1);
    all.push_back(-angle);
    all.push_back(angle);
  }
  return all;
}

}  // namespace

std::vector<PlatformPose> platform_poses(const Cell& cell, int steps) {
  const int mover = cell.platform ? mover_index(cell, cell.platform->body) : -1;
  if (mover < 0) return {PlatformPose{}};
  const RigidMotion rest = rest_of(cell.movers[static_cast<std::size_t>(mover)].motion);
  const Stroke& stroke = cell.platform->stroke;
  std::vector<PlatformPose> poses;
  for (const double yaw : angles(stroke.yaw_deg, steps)) {
    for (const double pitch : angles(stroke.pitch_deg, steps)) {
      for (const double roll : angles(stroke.roll_deg, steps)) {
        const Quaternion turn =
            rotation_from_yaw_pitch_roll(rad_from_deg(yaw), rad_from_deg(pitch), rad_from_deg(roll));
        poses.push_back({yaw, pitch, roll, rest * rotation_about(cell.platform->pivot_mm, turn)});
      }
    }
  }
  const auto turned = [](const PlatformPose& pose) {
    return std::abs(pose.yaw_deg) + std::abs(pose.pitch_deg) + std::abs(pose.roll_deg);
  };
  std::stable_sort(poses.begin(), poses.end(),
                   [&](const auto& a, const auto& b) { return turned(a) < turned(b); });
  return poses;
}

RigidMotion tracker_from_workpiece(const Cell& cell, const PlatformPose& pose) {
  require(cell.workpiece.has_value(), "there is a part");
  const Solid& part = *cell.workpiece;
  if (cell.platform && part.body == cell.platform->body) {
    return pose.tracker_from_platform * part.carrier_from_solid;
  }
  const int mover = mover_index(cell, part.body);
  if (mover < 0) return part.carrier_from_solid;
  return rest_of(cell.movers[static_cast<std::size_t>(mover)].motion) * part.carrier_from_solid;
}

}  // namespace asterism
