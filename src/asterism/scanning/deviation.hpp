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
  std::size_t points = 0, beyond = 0;  // compared; left out, for they lie farther off than `within_mm`
  double mean_mm = 0, rms_mm = 0, sigma_mm = 0;  // rms² = mean² + sigma²
  double p05_mm = 0, median_mm = 0, p95_mm = 0, lowest_mm = 0, highest_mm = 0;
  double in_tolerance = 0, below = 0, above = 0;  // shares of the points
  double predicted_rms_mm = 0;                    // of their own standard deviations; 0 = not known
};

/// Signed distances of a cloud from the part's nominal surface, outside positive.
struct Deviation {
  std::vector<double> mm;  // by point; NaN beyond `within_mm`
  DeviationSummary whole;
  std::vector<DeviationSummary> regions;
  double bin_mm = 0;
  std::vector<std::size_t> histogram;  // from −histogram_mm to +histogram_mm; what lies outside is in no bin
};

/// Takes a cloud piece by piece; memory does not grow with it. Sums are exact to rounding, percentiles to
/// within_mm / 32768 (0.15 µm of 5 mm): they come from a fine histogram.
class DeviationCount {
 public:
  DeviationCount(SurfaceTree surface, std::span<const ScanRegion> regions, const DeviationOptions& options);
  /// Returns the signed distances of these points; NaN beyond `within_mm`.
  std::vector<double> add(const Cloud& cloud);
  /// All but the distances by point.
  [[nodiscard]] Deviation finish() const;

 private:
  struct Spread {
    std::size_t points = 0, beyond = 0, below = 0, above = 0, with_sigma = 0;
    double sum = 0, squares = 0, variances = 0, lowest = 0, highest = 0;
    std::vector<std::size_t> fine;  // from −within_mm to +within_mm
  };
  void take(Spread& spread, double mm, double sigma_mm) const;
  [[nodiscard]] double quantile(const Spread& spread, double p) const;
  [[nodiscard]] DeviationSummary summary_of(const Spread& spread, const std::string& region) const;

  SurfaceTree surface_;
  std::vector<ScanRegion> regions_;
  DeviationOptions options_;
  std::vector<Spread> spreads_;  // of the whole, then by region
  std::vector<std::size_t> histogram_;
};

/// Cloud, surface and regions in the workpiece's frame. A field `sigma_mm` of the cloud is taken as each
/// point's standard deviation along its normal. A point of two regions counts in both.
[[nodiscard]] Deviation deviation_of(const Cloud& cloud, const SurfaceTree& surface,
                                     std::span<const ScanRegion> regions, const DeviationOptions& options);

/// Gives the cloud a field `deviation_mm`, or new values where it has one.
void add_deviation(Cloud& cloud, std::vector<double> mm);

}  // namespace asterism
