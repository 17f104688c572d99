// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "asterism/camera/disc_image.hpp"
#include "asterism/core/random.hpp"
#include "asterism/measurement/centre.hpp"
#include "asterism/tracking/pose.hpp"

// The tests' and benchmarks' cell: two converging cameras 1 m apart, 2.3 m before a platform with the six
// 12-mm discs of the paper's scheme S3 (Table 1).

namespace asterism::scene {

inline StereoRig rig(int coefficients = 0) {
  StereoRig r;
  r.left = {2400, 2402, 0, 1023.5, 767.5, {-0.12, 0.08, 3e-4, -2e-4, -0.02}, coefficients, 2048, 1536};
  r.right = {2398, 2401, 0, 1020.5, 770.0, {-0.11, 0.07, -2e-4, 3e-4, -0.01}, coefficients, 2048, 1536};
  const RigidMotion tracker_from_right{exp_rotation({0, -0.3, 0}), Vec3(1000, 0, 0)};
  r.right_from_left = tracker_from_right.inverse();
  return r;
}

inline Body body() {
  Body b{"platform", {}};
  const std::vector<Vec3> at = {{200, -100, 590}, {-100, 300, 610}, {-200, 100, 600},
                                {0, -250, 605},   {210, 180, 580},  {-200, -240, 590}};
  for (std::size_t i = 0; i < at.size(); ++i) {
    Target target;
    target.id = "P" + std::to_string(i + 1);
    target.position = at[i];
    target.normal = Vec3(at[i].x() * 1e-3, at[i].y() * 1e-3, 1).normalized();
    target.diameter_mm = 12.0;
    b.targets.push_back(target);
  }
  return b;
}

/// The body `range_mm` before the cameras, its z axis towards them, turned up to `swing_deg` about each axis.
inline RigidMotion pose(RandomStream& random, double swing_deg = 15, double range_mm = 2250) {
  const double s = rad_from_deg(swing_deg);
  const Quaternion towards = exp_rotation({std::numbers::pi, 0, 0}) * exp_rotation({0, 0.1, 0});
  const Quaternion turn =
      rotation_from_yaw_pitch_roll(random.uniform(-s, s), random.uniform(-s, s), random.uniform(-s, s));
  const Quaternion rotation = (towards * turn).normalized();
  // Where both cameras look.
  const Vec3 middle(500 - 0.15 * range_mm + random.uniform(-50, 50), random.uniform(-50, 50),
                    range_mm + random.uniform(-50, 50));
  return {rotation, middle - rotation * Vec3(0, 0, 600)};
}

inline Ellipse image_of(const StereoRig& r, const Body& b, const RigidMotion& tracker_from_body, int target,
                        Side side) {
  const Target& t = b.targets[static_cast<std::size_t>(target)];
  const RigidMotion camera_from_body = r.camera_from_tracker(side) * tracker_from_body;
  const Vec3 normal = t.normal ? Vec3(camera_from_body.rotation * *t.normal) : Vec3(Vec3::UnitZ());
  if (t.imaged_radius_mm() == 0) {
    Ellipse point;
    point.centre = project(r.lens(side), camera_from_body * t.position).value().px;
    return point;
  }
  const auto image =
      image_of_disc(r.lens(side), {camera_from_body * t.position, normal, t.imaged_radius_mm()});
  if (!image) throw std::runtime_error("the scene's target lies behind the camera");
  return *image;
}

/// A target's view with noise of `sigma_px` an axis.
inline TargetView view(const StereoRig& r, const Body& b, const RigidMotion& tracker_from_body, int target,
                       Side side, double sigma_px, RandomStream& random) {
  const Vec2 noise(random.normal(), random.normal());
  return {target, side, image_of(r, b, tracker_from_body, target, side).centre + sigma_px * noise,
          sigma_px * sigma_px * Mat2::Identity()};
}

/// Views of the targets named, in both cameras.
inline std::vector<TargetView> views(const StereoRig& r, const Body& b, const RigidMotion& tracker_from_body,
                                     const std::vector<int>& targets, double sigma_px, RandomStream& random) {
  std::vector<TargetView> all;
  for (const int target : targets) {
    for (const Side side : {Side::Left, Side::Right}) {
      all.push_back(view(r, b, tracker_from_body, target, side, sigma_px, random));
    }
  }
  return all;
}

inline std::vector<TargetView> views(const StereoRig& r, const Body& b, const RigidMotion& tracker_from_body,
                                     double sigma_px, RandomStream& random) {
  std::vector<int> targets(b.targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) targets[i] = static_cast<int>(i);
  return views(r, b, tracker_from_body, targets, sigma_px, random);
}

/// A centre as detection would give it.
inline Centre centre(const Ellipse& ellipse, double sigma_px, RandomStream& random) {
  Centre c;
  c.ellipse = ellipse;
  c.ellipse.centre += sigma_px * Vec2(random.normal(), random.normal());
  c.covariance = sigma_px * sigma_px * Mat2::Identity();
  c.amplitude = 180;
  return c;
}

}  // namespace asterism::scene
