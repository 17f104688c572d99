// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "asterism/cell/cell_checks.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kSlack =
    1 + 1e-4;  // a stroke used to its end is allowed, whatever rounding and smoothing add

struct Axis {
  const char* name;
  const char* unit;
  double stroke, rate;  // in that unit, and a second
};

std::array<Axis, 6> axes_of(const Stroke& stroke) {
  return {{{"yaw", "°", stroke.yaw_deg, stroke.rate_deg_s},
           {"pitch", "°", stroke.pitch_deg, stroke.rate_deg_s},
           {"roll", "°", stroke.roll_deg, stroke.rate_deg_s},
           {"x", " mm", stroke.x_mm, stroke.speed_mm_s},
           {"y", " mm", stroke.y_mm, stroke.speed_mm_s},
           {"z", " mm", stroke.z_mm, stroke.speed_mm_s}}};
}

/// A value and when it is reached.
struct Peak {
  double value = 0, time_s = 0;
};

void check_reach(const Axis& axis, const Peak& reach, const std::string& here) {
  if (std::abs(reach.value) <= axis.stroke * kSlack) return;
  throw InputError(here,
                   fmt::format("goes beyond the platform's stroke: {} {:.2f}{} at {:.2f} s; ±{}{} is allowed",
                               axis.name, reach.value, axis.unit, reach.time_s, axis.stroke, axis.unit));
}

void check_rate(const Axis& axis, const Peak& rate, const std::string& here) {
  if (std::abs(rate.value) <= axis.rate * kSlack) return;
  throw InputError(
      here, fmt::format("is faster than the platform: {} at {:.1f}{}/s at {:.2f} s; {}{}/s is allowed",
                        axis.name, std::abs(rate.value), axis.unit, rate.time_s, axis.rate, axis.unit));
}

/// Where |sin(2π f t + phase)| is largest between two moments, first of all.
Peak peak_of_sine(double frequency_hz, double phase_rad, double from_s, double to_s) {
  const auto at = [&](double t) { return std::sin(2 * std::numbers::pi * frequency_hz * t + phase_rad); };
  if (frequency_hz == 0) return {at(from_s), from_s};
  const double half_turns = 2 * frequency_hz * from_s + phase_rad / std::numbers::pi - 0.5;
  const double next = (frequency_hz > 0 ? std::ceil(half_turns) : std::floor(half_turns)) + 0.5;
  const double time_s = (next - phase_rad / std::numbers::pi) / (2 * frequency_hz);
  if (time_s <= to_s) return {at(time_s), time_s};
  return std::abs(at(from_s)) >= std::abs(at(to_s)) ? Peak{at(from_s), from_s} : Peak{at(to_s), to_s};
}

void check_sweep(const Sweep& sweep, const std::array<Axis, 6>& axes, const std::string& here) {
  const double from_s = sweep.from_s.value_or(0);
  const double to_s = sweep.to_s.value_or(std::numeric_limits<double>::infinity());
  const std::array<const Swing*, 6> swings = {&sweep.yaw, &sweep.pitch, &sweep.roll,
                                              &sweep.x,   &sweep.y,     &sweep.z};
  for (std::size_t i = 0; i < 6; ++i) {
    const double unit = i < 3 ? deg_from_rad(1) : 1;
    const Swing& swing = *swings[i];
    Peak reach = peak_of_sine(swing.frequency_hz, swing.phase_rad, from_s, to_s);
    reach.value *= unit * swing.amplitude;
    check_reach(axes[i], reach, here);
    Peak rate = peak_of_sine(swing.frequency_hz, swing.phase_rad + 0.5 * std::numbers::pi, from_s, to_s);
    rate.value *= unit * swing.amplitude * 2 * std::numbers::pi * swing.frequency_hz;
    check_rate(axes[i], rate, here);
  }
}

using Reading = std::array<double, 6>;  // of the six axes, ° and mm

Reading reading_of(const RigidMotion& rest_from_now, const Vec3& pivot) {
  const Mat3 r = rest_from_now.rotation.toRotationMatrix();
  const Vec3 shift = rest_from_now * pivot - pivot;
  return {deg_from_rad(std::atan2(r(1, 0), r(0, 0))),
          deg_from_rad(std::asin(std::clamp(-r(2, 0), -1.0, 1.0))),
          deg_from_rad(std::atan2(r(2, 1), r(2, 2))),
          shift.x(),
          shift.y(),
          shift.z()};
}

void check_keyed(const KeyedMotion& motion, const Vec3& pivot, const std::array<Axis, 6>& axes,
                 const std::string& here) {
  const std::size_t intervals = motion.keys.size() - 1;
  if (intervals == 0) return;
  const std::size_t looks = std::clamp<std::size_t>(20000 / intervals, 4, 50);  // an interval
  const RigidMotion now_from_tracker = pose_at(motion, 0).inverse();
  Reading before{};
  double before_s = 0;
  for (std::size_t k = 0; k <= intervals * looks; ++k) {
    const std::size_t i = std::min(k / looks, intervals - 1);
    const double share = static_cast<double>(k - i * looks) / static_cast<double>(looks);
    const double time_s = motion.keys[i].time_s + share * (motion.keys[i + 1].time_s - motion.keys[i].time_s);
    const Reading now = reading_of(now_from_tracker * pose_at(motion, time_s), pivot);
    for (std::size_t axis = 0; axis < 6; ++axis) {
      check_reach(axes[axis], {now[axis], time_s}, here);
      if (k == 0) continue;
      const double step = axis < 3 ? std::remainder(now[axis] - before[axis], 360) : now[axis] - before[axis];
      check_rate(axes[axis], {step / (time_s - before_s), time_s}, here);
    }
    before = now;
    before_s = time_s;
  }
}

}  // namespace

void check_platform_motion(const Cell& cell, const std::string& where) {
  if (!cell.platform) return;
  const Platform& platform = *cell.platform;
  check_carrier(platform.body, cell, where + ": [platform]", "it is");
  if (!platform.pivot_mm.allFinite()) throw InputError(where, "[platform]: its pivot is not a finite number");
  const std::array<Axis, 6> axes = axes_of(platform.stroke);
  for (const Mover& mover : cell.movers) {
    if (mover.body.name != platform.body) continue;
    const std::string here = fmt::format("{}: body `{}`", where, mover.body.name);
    if (const auto* sweep = std::get_if<Sweep>(&mover.motion)) {
      check_sweep(*sweep, axes, here);
    } else {
      check_keyed(std::get<KeyedMotion>(mover.motion), platform.pivot_mm, axes, here);
    }
  }
}

}  // namespace asterism
