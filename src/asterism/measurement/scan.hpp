// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// What a scanner measured from one view, or while it passed by: points in its own frame, each at its moment.
struct Scan {
  int number = 0;
  std::string body = "scanner";   // carries the scanner
  double time_s = 0;              // of points without a time of their own
  std::vector<Vec3f> in_scanner;  // mm
  std::vector<double> times_s;    // one a point, or none at all
  std::vector<Vec3f> normals;     // one a point (unit, towards the scanner; zero = not known), or none at all

  [[nodiscard]] double time_of(std::size_t point) const { return times_s.empty() ? time_s : times_s[point]; }
};

}  // namespace asterism
