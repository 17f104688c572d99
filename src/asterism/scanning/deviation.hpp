// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "asterism/cell/scan_task.hpp"
#include "asterism/core/options.hpp"
#include "asterism/geometry/surface_tree.hpp"
#include "asterism/measurement/cloud.hpp"

namespace asterism {

struct DeviationOptions {
  double tolerance_mm = 0.1;  // to either side
  double within_mm = 5;       // what is farther off belongs to something else: counted, and left out
  int bins = 61;              // of the histogram
  double histogram_mm = 0.5;  // to either side
};
void describe(DeviationOptions& options, OptionVisitor& visit);

/// How deviations are spread.
struct DeviationSummary {
  std::string region;                  // empty = the whole
  std::size_t points = 0, beyond = 0;  // beyond = farther off than `within_mm`
  double mean_mm = 0, rms_mm = 0, sigma_mm = 0;
  double p05_mm = 0, median_mm = 0, p95_mm = 0, lowest_mm = 0, highest_mm = 0;
  double in_tolerance = 0, below = 0, above = 0;  // shares of the points
  double predicted_rms_mm = 0;  // from the points' own covariance along the normal; 0 = not known
};

/// Signed distances of a cloud from the part's nominal surface, outside positive.
struct Deviation {
  std::vector<double> mm;  // by point; NaN beyond `within_mm`
  DeviationSummary whole;
  std::vector<DeviationSummary> regions;
  double bin_mm = 0;
  std::vector<std::size_t> histogram;
};

/// Cloud, surface and regions in the workpiece's frame. A field `sigma_mm` of the cloud is taken as each
/// point's standard deviation along its normal.
[[nodiscard]] Deviation deviation_of(const Cloud& cloud, const SurfaceTree& surface,
                                     std::span<const ScanRegion> regions, const DeviationOptions& options);

}  // namespace asterism
