// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "asterism/measurement/pose.hpp"

namespace asterism {

/// A body's measured poses (OK and PARTIAL) in order of time, without what is systematic in their covariance.
struct PoseCurve {
  std::vector<double> times_s;
  std::vector<RigidMotion> tracker_from_body;
  std::vector<Mat6> noise;
};
[[nodiscard]] PoseCurve curve_of(std::span<const TimedPose> tracked);

/// The pose between four neighbours: the cubic through them, of the translation and of the rotation vector
/// from the second one.
struct PoseBetween {
  std::size_t first = 0;        // of the four
  std::array<double, 4> share;  // the pose leans on each by so much (their sum is 1),
  std::array<double, 4> slope;  // the velocity by so much (per second)
  RigidMotion tracker_from_body;
  Vec6 velocity;  // rad/s, mm/s of the body's origin; along the tracker's axes
};
/// Empty where not two poses lie on either side, or two neighbours are further apart than the largest gap.
[[nodiscard]] std::optional<PoseBetween> pose_between(const PoseCurve& curve, double time_s,
                                                      double largest_gap_s);

}  // namespace asterism
