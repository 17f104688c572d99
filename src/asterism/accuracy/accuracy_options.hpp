// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/accuracy/centre_sigma.hpp"
#include "asterism/core/options.hpp"

namespace asterism {

struct AccuracyOptions {
  double sigma_px = 0.05;    // of a target's centre in an image, each axis
  double map_sigma_mm = 0;   // of the targets' coordinates, each axis, where a target states no covariance
  bool single_views = true;  // count targets that only one camera sees, as the pose estimator does
  double max_sigma_deg = 1;  // beyond it a pose counts as not determined, as the pose estimator has it
  int losses = 1;            // any so many targets lost: 0, 1 or 2
  std::optional<CentreBound> bound;  // where given, its variance is added to sigma_px²
};
void describe(AccuracyOptions& options, OptionVisitor& visit);

}  // namespace asterism
