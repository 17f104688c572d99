// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "asterism/cell/motion.hpp"
#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/measurement/pose.hpp"
#include "asterism/measurement/reading.hpp"

namespace asterism::scene {

/// A platform that sweeps as the paper's does, tracked and telling its own pose.
struct SweepingPlatform {
  Sweep motion;
  RigidMotion tracker_from_base;
  double latency_s = 0.03;
  double frame_rate_hz = 20, reading_rate_hz = 100, seconds = 6;
  Mat6 pose_noise = Mat6::Zero(), reading_noise = Mat6::Zero();
  double correlation_s = 0;
  double jump_share = 0, jump_mm = 0;

  SweepingPlatform() {
    motion.tracker_from_rest = {exp_rotation({2.0, 0.7, -0.4}), Vec3(50, -80, 2200)};
    motion.yaw = {rad_from_deg(15), 0.17, 0};
    motion.pitch = {rad_from_deg(15), 0.23, 0.7};
    motion.roll = {rad_from_deg(15), 0.29, 1.9};
    motion.pivot_mm = {0, 0, 600};
    tracker_from_base = motion.tracker_from_rest;
    pose_noise.diagonal() << 1e-8, 1e-8, 1e-8, 4e-4, 4e-4, 3e-3;
    reading_noise.diagonal() << Vec3::Constant(3.6e-7), Vec3::Constant(0.034);  // 0.0345°, 0.185 mm
  }

  [[nodiscard]] RigidMotion truth(double time_s) const { return pose_at(motion, time_s); }

  [[nodiscard]] std::vector<TimedPose> tracked(std::uint64_t seed) const {
    std::vector<TimedPose> poses;
    for (int i = 0; i < std::lround(seconds * frame_rate_hz); ++i) {
      RandomStream random(seed, static_cast<std::uint64_t>(i), 1);
      const double time_s = i / frame_rate_hz;
      PoseEstimate estimate;
      estimate.tracker_from_body = perturbed(truth(time_s), draw(pose_noise, random));
      estimate.covariance = pose_noise;
      poses.push_back({time_s, {0, PoseStatus::Ok, estimate, 6, 0.01}});
    }
    return poses;
  }

  [[nodiscard]] std::vector<PlatformReading> readings(std::uint64_t seed) const {
    std::vector<PlatformReading> told;
    const double keeps = correlation_s > 0 ? std::exp(-1 / (reading_rate_hz * correlation_s)) : 0.0;
    Vec6 error = Vec6::Zero();
    for (int i = 0; i < std::lround(seconds * reading_rate_hz); ++i) {
      RandomStream random(seed, static_cast<std::uint64_t>(i), 2);
      const Vec6 fresh = draw(reading_noise, random);
      error = i == 0 ? fresh : Vec6(keeps * error + std::sqrt(1 - keeps * keeps) * fresh);
      const double time_s = i / reading_rate_hz;
      RigidMotion base_from_body = tracker_from_base.inverse() * truth(time_s - latency_s);
      if (random.uniform() < jump_share) base_from_body.translation.x() += jump_mm;
      told.push_back({time_s, perturbed(base_from_body, error), reading_noise,
                      correlation_s > 0 ? reading_noise : Mat6(Mat6::Zero())});
    }
    return told;
  }

  /// Noise of a diagonal covariance.
  [[nodiscard]] static Vec6 draw(const Mat6& covariance, RandomStream& random) {
    Vec6 error;
    for (Eigen::Index i = 0; i < 6; ++i) error(i) = std::sqrt(covariance(i, i)) * random.normal();
    return error;
  }
};

}  // namespace asterism::scene
