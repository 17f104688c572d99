// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/platform.hpp"

namespace asterism {

void describe(Stroke& stroke, OptionVisitor& visit) {
  constexpr Limits kAngle = {0, 180};
  constexpr Limits kWay = {0, 1e5};
  visit.number("yaw_deg", stroke.yaw_deg, kAngle, "to either side of rest, about z");
  visit.number("pitch_deg", stroke.pitch_deg, kAngle, "to either side of rest, about y");
  visit.number("roll_deg", stroke.roll_deg, kAngle, "to either side of rest, about x");
  visit.number("x_mm", stroke.x_mm, kWay, "to either side of rest, along x");
  visit.number("y_mm", stroke.y_mm, kWay, "to either side of rest, along y");
  visit.number("z_mm", stroke.z_mm, kWay, "to either side of rest, along z");
  visit.number("rate_deg_s", stroke.rate_deg_s, {0, 1e5}, "fastest rotation about any axis");
  visit.number("speed_mm_s", stroke.speed_mm_s, {0, 1e6}, "fastest translation along any axis");
}

void describe(ReadOut& read_out, OptionVisitor& visit) {
  visit.number("rotation_sigma_deg", read_out.rotation_sigma_deg, {0, 90}, "noise about each axis, 1 sigma");
  visit.number("translation_sigma_mm", read_out.translation_sigma_mm, {0, 1e4},
               "noise along each axis at the pivot, 1 sigma");
  visit.number("jump_share", read_out.jump_share, {0, 1}, "share of readings with a jump");
  visit.number("jump_low_mm", read_out.jump_low_mm, {0, 1e4}, "smallest jump");
  visit.number("jump_high_mm", read_out.jump_high_mm, {0, 1e4}, "largest jump");
  visit.number("rate_hz", read_out.rate_hz, {1e-3, 1e5}, "readings a second");
  visit.number("latency_s", read_out.latency_s, {-10, 10},
               "a reading tells of where the platform was so long before its time stamp");
  visit.number("correlation_s", read_out.correlation_s, {0, 1e4},
               "time over which the noise keeps its value; 0 = each reading anew");
}

}  // namespace asterism
