// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/tracking/filter.hpp"

namespace asterism::scene {

/// A body whose twist wanders as the filter believes, integrated in steps of a millisecond.
struct MovingBody {
  FilterOptions options;
  double time_s = 0;
  RigidMotion truth{exp_rotation({0.3, 2.0, -0.4}), Vec3(100, -50, 2300)};
  Vec6 twist = Vec6::Zero();
  Mat6 noise = Mat6::Zero();

  MovingBody(const FilterOptions& o, RandomStream& random) : options(o) {
    for (int i = 0; i < 3; ++i) twist(i) = 0.3 * random.normal();
    for (int i = 3; i < 6; ++i) twist(i) = 200 * random.normal();
    noise.diagonal() << 1e-8, 2e-8, 1e-8, 4e-4, 4e-4, 3e-3;
    noise(0, 4) = noise(4, 0) = 1e-6;
  }

  void move(double seconds, RandomStream& random) {
    constexpr double kStep_s = 1e-3;
    for (int i = 0; i < std::lround(seconds / kStep_s); ++i) {
      Vec6 gain;
      for (int k = 0; k < 6; ++k) {
        gain(k) = (k < 3 ? rad_from_deg(options.rate_wander_deg_s) : options.speed_wander_mm_s) *
                  std::sqrt(kStep_s) * random.normal();
      }
      const Vec6 mean = twist + 0.5 * gain;
      truth.translation +=
          truth.rotation * (left_jacobian(mean.head<3>() * kStep_s) * mean.tail<3>()) * kStep_s;
      truth.rotation = (truth.rotation * exp_rotation(mean.head<3>() * kStep_s)).normalized();
      twist += gain;
      time_s += kStep_s;
    }
  }

  [[nodiscard]] BodyPose measured(RandomStream& random) const {
    Vec6 error;
    for (int i = 0; i < 6; ++i) error(i) = std::sqrt(noise(i, i)) * random.normal();
    const double rho = noise(0, 4) / std::sqrt(noise(0, 0) * noise(4, 4));
    error(4) = std::sqrt(noise(4, 4)) *
               (rho * error(0) / std::sqrt(noise(0, 0)) + std::sqrt(1 - rho * rho) * random.normal());
    PoseEstimate estimate;
    estimate.tracker_from_body = perturbed(truth, error);
    estimate.covariance = noise;
    return {0, PoseStatus::Ok, estimate, 6, 0.01};
  }
};

inline double nees(const PoseEstimate& estimate, const RigidMotion& truth) {
  const Vec6 error = difference(estimate.tracker_from_body, truth);
  return error.dot(*solve_positive(estimate.covariance, error));
}

}  // namespace asterism::scene
