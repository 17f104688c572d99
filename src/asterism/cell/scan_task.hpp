// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asterism/cell/shape.hpp"
#include "asterism/core/options.hpp"

namespace asterism {

/// A part of the workpiece's surface that counts more, less or not at all: what lies inside the shape.
struct ScanRegion {
  std::string name;
  Shape shape;
  RigidMotion workpiece_from_shape;
  double weight = 1;  // 0: need not be scanned
};

/// What a plan of views is asked for, and what views cost. The paper states no times: t_s = 5 s a station,
/// T_r = 10 s a turn of the platform are assumed (LEDGER 2.6).
struct ScanTask {
  double share = 0.99;             // of what this cell lets be measured, by area and weight
  int views_each = 1;              // from how many views each place is to be measured
  double tolerance_mm = 0.15;      // largest predicted standard deviation of a point along its normal
  double view_s = 5;               // a view takes so long,
  double turn_s = 10;              // a turn of the platform so long,
  double speed_mm_s = 250;         // and the scanner's way from view to view,
  double rate_deg_s = 45;          // turning,
  double settle_s = 0.5;           // with a rest before each view
  std::optional<double> floor_mm;  // the scanner stays above this height in the platform's frame at rest
  std::vector<ScanRegion> regions;
};
/// All but its floor and regions.
void describe(ScanTask& task, OptionVisitor& visit);

/// A time in which the scanner measures: sweep after sweep, from the first moment on.
struct ScanPass {
  int scan = 0;  // its number
  double from_s = 0, to_s = 0;
};

}  // namespace asterism
