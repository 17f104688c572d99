// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/papers_cell.hpp"

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

const Vec3 kMiddle{0, 0, 600};
constexpr double kBaselineMm = 1000, kFocalMm = 16, kPixelMm = 3.45e-3;
constexpr double kStartS = 5, kEndS = 9, kLastS = 12, kStepS = 0.02;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
}

struct RingTarget {
  Vec3 centre, normal;
};

std::vector<RingTarget> ring_targets(const RingOfTargets& ring) {
  std::vector<RingTarget> targets;
  for (int k = 0; k < 8; ++k) {
    const double azimuth = rad_from_deg(22.5 + 45 * k);
    const Vec3 outward(std::cos(azimuth), std::sin(azimuth), 0);
    const Vec3 centre = 300 * outward + Vec3(0, 0, 600 + (k % 2 == 0 ? 10 : -10));
    targets.push_back({centre, std::sin(ring.tilt_rad) * outward + Vec3(0, 0, std::cos(ring.tilt_rad))});
  }
  return targets;
}

}  // namespace

Vec3 tracker_position(const TrackerPlace& place) {
  const Vec3 towards(std::cos(place.elevation_rad) * std::cos(place.azimuth_rad),
                     std::cos(place.elevation_rad) * std::sin(place.azimuth_rad),
                     std::sin(place.elevation_rad));
  return kMiddle + place.range_mm * towards;
}

StereoRig stereo_rig() {
  const double f_px = kFocalMm / kPixelMm;
  StereoRig rig;
  rig.left = rig.right = {f_px, f_px, 0, 2047.5, 1499.5, {}, 0, 4096, 3000};
  rig.right_from_left.translation = Vec3(-kBaselineMm, 0, 0);
  return rig;
}

RigidMotion rig_from_platform(const TrackerPlace& place) {
  const Vec3 position = tracker_position(place);
  const Vec3 forward = (kMiddle - position).normalized();
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized();
  Mat3 platform_axes;  // the rig's axes in the platform: x right, y down, z forward
  platform_axes << right, forward.cross(right), forward;
  const RigidMotion platform_from_rig{quaternion_from_matrix(platform_axes),
                                      position - kBaselineMm / 2 * right};
  return platform_from_rig.inverse();
}

std::vector<SightOfRing> watch_ring(const TrackerPlace& place, const RingOfTargets& ring) {
  const std::vector<RingTarget> targets = ring_targets(ring);
  const Vec3 tracker = tracker_position(place), axis = kMiddle - tracker;
  std::vector<SightOfRing> sights;
  const int last = static_cast<int>(std::lround(kLastS / kStepS));
  for (int i = 0; i <= last; ++i) {
    SightOfRing sight;
    sight.time_s = i * kStepS;
    const double tau = sight.time_s - kStartS;
    if (tau >= 0 && sight.time_s <= kEndS) {
      sight.turn_x_rad = rad_from_deg(15) * std::sin(2 * std::numbers::pi * 0.5 * tau);
      sight.turn_y_rad = rad_from_deg(15) * std::sin(2 * std::numbers::pi * 0.25 * tau);
    }
    const Quaternion turn = exp_rotation({sight.turn_x_rad, 0, 0}) * exp_rotation({0, sight.turn_y_rad, 0});
    for (const RingTarget& target : targets) {
      const Vec3 ray = turn * target.centre - tracker;
      sight.visible += angle_between(turn * target.normal, -ray) <= ring.acceptance_rad &&
                       angle_between(ray, axis) <= place.cone_half_angle_rad;
    }
    const Vec3 ray = turn * kMiddle - tracker;
    sight.off_axis_rad = angle_between(ray, axis);
    if (sight.off_axis_rad <= place.cone_half_angle_rad) {
      sight.coverage = std::max(0.0, std::cos(angle_between(turn * Vec3::UnitZ(), -ray)));
    }
    sights.push_back(sight);
  }
  return sights;
}

}  // namespace asterism
