// SPDX-License-Identifier: Apache-2.0
#include "asterism/measurement/pose_curve.hpp"

#include <algorithm>

namespace asterism {
namespace {

/// Lagrange's weights of four times at another, and their derivatives.
void lagrange(const double* times, double at, PoseBetween& between) {
  for (std::size_t i = 0; i < 4; ++i) {
    double scale = 1, value = 1, slope = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j == i) continue;
      scale *= times[i] - times[j];
      slope = slope * (at - times[j]) + value;
      value *= at - times[j];
    }
    between.share[i] = value / scale;
    between.slope[i] = slope / scale;
  }
}

}  // namespace

PoseCurve curve_of(std::span<const TimedPose> tracked) {
  PoseCurve curve;
  for (const auto& [time_s, pose] : tracked) {
    if (pose.status != PoseStatus::Ok && pose.status != PoseStatus::Partial) continue;
    curve.times_s.push_back(time_s);
    curve.tracker_from_body.push_back(pose.estimate.value().tracker_from_body);
    curve.noise.push_back(pose.estimate->covariance - pose.estimate->systematic);
  }
  return curve;
}

std::optional<PoseBetween> pose_between(const PoseCurve& curve, double time_s, double largest_gap_s) {
  const auto& times = curve.times_s;
  const auto after = std::upper_bound(times.begin(), times.end(), time_s);
  if (after - times.begin() < 2 || times.end() - after < 2) return std::nullopt;
  PoseBetween between;
  between.first = static_cast<std::size_t>(after - times.begin()) - 2;
  const double* four = &times[between.first];
  for (int i = 0; i < 3; ++i) {
    const double gap = four[i + 1] - four[i];
    if (gap <= 0 || gap > largest_gap_s) return std::nullopt;
  }
  lagrange(four, time_s, between);
  const RigidMotion& from = curve.tracker_from_body[between.first + 1];
  Vec6 way = Vec6::Zero(), rate = Vec6::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec6 step = difference(curve.tracker_from_body[between.first + i], from);
    way += between.share[i] * step;
    rate += between.slope[i] * step;
  }
  between.tracker_from_body = perturbed(from, way);
  between.velocity = rate;
  between.velocity.head<3>() = left_jacobian(way.head<3>()) * rate.head<3>();
  return between;
}

}  // namespace asterism
