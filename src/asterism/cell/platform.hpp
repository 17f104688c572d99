// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "asterism/core/options.hpp"
#include "asterism/geometry/types.hpp"

namespace asterism {

/// How far and how fast a platform of six axes goes from its place of rest; the paper's Table 8 states ±15°
/// for its three rotations.
struct Stroke {
  double yaw_deg = 15, pitch_deg = 15, roll_deg = 15;  // to either side
  double x_mm = 200, y_mm = 200, z_mm = 200;
  double rate_deg_s = 200;   // of any rotation
  double speed_mm_s = 1000;  // of any translation
};

/// What the platform says of its own pose without being watched: normal noise about each axis, and now and
/// then a jump (backlash, a slipping drive). The defaults give what the paper draws for "without targets" in
/// its Figs. 21 and 22: mean 0.055° and 0.31 mm. An assumption: the paper does not tell how it had that pose.
struct ReadOut {
  double rotation_sigma_deg = 0.0345;   // about each axis
  double translation_sigma_mm = 0.185;  // along each axis, at the pivot
  double jump_share = 0.05;             // of all readings
  double jump_low_mm = 0.35, jump_high_mm = 0.65;
  double rate_hz = 100;
  double latency_s = 0;      // a reading tells of where the platform was so long before its time stamp
  double correlation_s = 0;  // of the noise from reading to reading; 0 = each anew
};

/// The body that turns the workpiece. Its axes are told by its own motion: a Sweep's rest and pivot.
struct Platform {
  std::string body = "platform";
  Vec3 pivot_mm = Vec3::Zero();  // in the body's frame
  Stroke stroke;
  ReadOut read_out;
};
void describe(Stroke& stroke, OptionVisitor& visit);
void describe(ReadOut& read_out, OptionVisitor& visit);

}  // namespace asterism
