// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "asterism/core/options.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// A triangulating scanner that is tracked by the targets on its housing. Its frame: origin midway between
/// projector and camera, x from the projector to the camera, z towards the part. Table 8 of the paper: best
/// at 300 mm, 350 × 310 mm wide there; the rest is not told there and assumed.
struct Scanner {
  std::string body = "scanner";
  RigidMotion body_from_scanner;
  double stand_off_mm = 300;
  double near_mm = 200, far_mm = 400;
  double field_width_mm = 350, field_height_mm = 310;  // at the stand-off, along its x and y
  double max_incidence_deg = 60;                       // beyond it nothing is measured,
  double good_incidence_deg = 45;                      // up to it a surface is measured well
  double baseline_mm = 160;                            // projector at x = −80, camera at x = +80
  double clearance_mm = 110;  // of a ball about its origin that nothing may enter: housing and hand

  double depth_sigma_mm =
      0.025;  // of a point along z, square on at the stand-off; grows as z² / cos incidence
  double lateral_sigma_mm = 0.012;       // across, at the stand-off; grows as z
  double outlier_share = 0.001;          // of all points,
  double outlier_mm = 8;                 // off along the line of sight by up to so much
  int lines = 140, points_a_line = 124;  // along y, swept along x: 2.5 mm apart at the stand-off
  double sweep_s = 0.5;                  // from the first line to the last
  double place_sigma_mm = 0.01;          // of body_from_scanner, each axis: what hand–eye calibration left,
  double place_sigma_deg = 0.002;        // about each axis
};
/// All but its pose.
void describe(Scanner& scanner, OptionVisitor& visit);

/// Standard deviations of one point along the scanner's x (= y) and z, mm.
struct RangeNoise {
  double lateral_mm, depth_mm;
};
/// `z_mm` is its depth; `cos_incidence` that of the angle between its normal and the line of sight.
[[nodiscard]] RangeNoise range_noise(const Scanner& scanner, double z_mm, double cos_incidence);

}  // namespace asterism
