// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

// The pattern behind a list of scanning stations: rings about one axis, possibly turned about y.

namespace asterism {

struct ScanRing {
  double z_mm = 0;       // along the axis, before the turn
  double radius_mm = 0;  // mean
  std::size_t points = 0;
};

struct ScanRings {
  std::vector<ScanRing> rings;   // by z
  double tilt_deg = 0;           // turn about y that lays the rings flat
  double step_deg = 0;           // between neighbours in azimuth
  double radius_at_zero_mm = 0;  // the cone through the rings: radius = radius_at_zero + slope · z
  double slope = 0;
  double residual_mm = 0;          // largest distance of a point from its ring, in radius or in z
  std::size_t points = 0;          // as listed
  std::size_t pattern_points = 0;  // when every ring has as many as the fullest
};

[[nodiscard]] ScanRings fit_rings(std::span<const Vec3> stations);

}  // namespace asterism
