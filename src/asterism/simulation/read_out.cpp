// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/read_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/result.hpp"
#include "asterism/simulation/streams.hpp"

namespace asterism {
namespace {

const Mover& platform_of(const Cell& cell) {
  if (!cell.platform) throw InputError(cell.name, "has no [platform]; there is no read-out to simulate");
  const int index = mover_index(cell, cell.platform->body);
  if (index < 0) {
    throw InputError(cell.name, fmt::format("its platform turns body `{}`, which is not in the cell",
                                            cell.platform->body));
  }
  return cell.movers[static_cast<std::size_t>(index)];
}

RigidMotion rest_of(const Motion& motion) {
  const auto* sweep = std::get_if<Sweep>(&motion);
  return sweep != nullptr ? sweep->tracker_from_rest
                          : std::get<KeyedMotion>(motion).keys.front().tracker_from_body;
}

/// Mean of a jump's squared length: it is even between its bounds.
double mean_square(double low, double high) { return (low * low + low * high + high * high) / 3; }

/// Covariance of a pose whose error is the same about each axis and, at a point of the body, along each.
Mat6 covariance_at_origin(double rotation_variance, double translation_variance, const Vec3& arm) {
  Mat6 at_point = Mat6::Zero();
  at_point.diagonal().head<3>().setConstant(rotation_variance);
  at_point.diagonal().tail<3>().setConstant(translation_variance);
  Mat6 carried = Mat6::Identity();  // t = pivot − R p, so an error of R moves t by [R p]× ω
  carried.bottomLeftCorner<3, 3>() = skew(arm);
  return carried * at_point * carried.transpose();
}

/// A reading's error: about the base's axes, and of the pivot along them.
Vec6 scaled(const Vec6& normal, const ReadOut& model) {
  Vec6 error;
  error << rad_from_deg(model.rotation_sigma_deg) * normal.head<3>(),
      model.translation_sigma_mm * normal.tail<3>();
  return error;
}

Vec6 normal_six(RandomStream& random) {
  Vec6 six;
  for (Eigen::Index i = 0; i < 6; ++i) six(i) = random.normal();
  return six;
}

/// Drawn whether or not there is a jump, so that one reading's fate does not change the others' noise.
Vec3 jump(RandomStream& random, const ReadOut& model) {
  const bool jumps = random.uniform() < model.jump_share;
  Vec3 direction;
  for (Eigen::Index i = 0; i < 3; ++i) direction(i) = random.normal();
  const double length = random.uniform(model.jump_low_mm, model.jump_high_mm);
  return jumps ? Vec3(length * direction.normalized()) : Vec3(Vec3::Zero());
}

}  // namespace

RigidMotion tracker_from_base(const Cell& cell) { return rest_of(platform_of(cell).motion); }

PlatformReading true_reading(const Cell& cell, double time_s) {
  const Mover& mover = platform_of(cell);
  const ReadOut& model = cell.platform->read_out;
  PlatformReading reading;
  reading.time_s = time_s;
  reading.base_from_body = rest_of(mover.motion).inverse() * pose_at(mover.motion, time_s);
  const Vec3 arm = reading.base_from_body.rotation * cell.platform->pivot_mm;
  const double jumps = model.jump_share * mean_square(model.jump_low_mm, model.jump_high_mm) / 3;
  const double turn = std::pow(rad_from_deg(model.rotation_sigma_deg), 2);
  const double shift = std::pow(model.translation_sigma_mm, 2);
  reading.covariance = covariance_at_origin(turn, shift + jumps, arm);
  if (model.correlation_s > 0) reading.correlated = covariance_at_origin(turn, shift, arm);
  return reading;
}

std::vector<PlatformReading> simulate_read_out(const Cell& cell, std::uint64_t seed) {
  static_cast<void>(platform_of(cell));
  const Vec3& pivot = cell.platform->pivot_mm;
  const ReadOut& model = cell.platform->read_out;
  const double end_s = (cell.timing.frames - 1) / cell.timing.rate_hz + std::max(0.0, model.latency_s);
  const double keeps = model.correlation_s > 0 ? std::exp(-1 / (model.rate_hz * model.correlation_s)) : 0.0;
  const int count = static_cast<int>(std::floor(end_s * model.rate_hz + 1e-9)) + 1;
  std::vector<PlatformReading> readings;
  Vec6 noise = Vec6::Zero();
  for (int k = 0; k < count; ++k) {
    RandomStream random(seed, static_cast<std::uint64_t>(k), static_cast<std::uint32_t>(Purpose::ReadOut));
    const Vec6 fresh = normal_six(random);
    noise = k == 0 ? fresh : Vec6(keeps * noise + std::sqrt(1 - keeps * keeps) * fresh);
    const Vec6 error = scaled(noise, model);
    const double stamp_s = k / model.rate_hz;
    PlatformReading reading = true_reading(cell, stamp_s - model.latency_s);
    reading.time_s = stamp_s;
    const Vec3 pivot_in_base = reading.base_from_body * pivot + error.tail<3>() + jump(random, model);
    RigidMotion& read = reading.base_from_body;
    read.rotation = (exp_rotation(error.head<3>()) * read.rotation).normalized();
    read.translation = pivot_in_base - read.rotation * pivot;
    readings.push_back(reading);
  }
  return readings;
}

}  // namespace asterism
