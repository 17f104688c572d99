// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asterism/cell/shape_distance.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::size_t kFineBins = 65536;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// By region and point: is it inside?
std::vector<std::vector<std::uint8_t>> membership(std::span<const Vec3> points,
                                                  std::span<const ScanRegion> regions) {
  std::vector<std::vector<std::uint8_t>> inside(regions.size(), std::vector<std::uint8_t>(points.size()));
  constexpr std::size_t kChunk = 8192;
  parallel_for((points.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const RigidMotion shape_from_workpiece = regions[r].workpiece_from_shape.inverse();
      for (std::size_t i = chunk * kChunk; i < end; ++i) {
        inside[r][i] = distance_from(regions[r].shape, shape_from_workpiece * points[i]) <= 0 ? 1 : 0;
      }
    }
  });
  return inside;
}

}  // namespace

void describe(DeviationOptions& options, OptionVisitor& visit) {
  visit.number("tolerance_mm", options.tolerance_mm, {1e-6, 1e4}, "to either side of the nominal surface");
  visit.number("within_mm", options.within_mm, {1e-3, 1e5},
               "a point farther off belongs to something else: counted, and left out");
  visit.integer("bins", options.bins, {3, 10001}, "bars of the histogram");
  visit.number("histogram_mm", options.histogram_mm, {1e-6, 1e5}, "the histogram goes so far to either side");
}

DeviationCount::DeviationCount(SurfaceTree surface, std::span<const ScanRegion> regions,
                               const DeviationOptions& options)
    : surface_(std::move(surface)),
      regions_(regions.begin(), regions.end()),
      options_(options),
      spreads_(1 + regions.size()),
      histogram_(static_cast<std::size_t>(options.bins), 0) {
  require(options.within_mm > 0 && options.histogram_mm > 0 && options.bins > 0,
          "deviations are looked for in a range");
  for (Spread& spread : spreads_) spread.fine.assign(kFineBins, 0);
}

void DeviationCount::take(Spread& spread, double mm, double sigma_mm) const {
  if (std::isnan(mm)) {
    ++spread.beyond;
    return;
  }
  spread.lowest = spread.points == 0 ? mm : std::min(spread.lowest, mm);
  spread.highest = spread.points == 0 ? mm : std::max(spread.highest, mm);
  ++spread.points;
  spread.sum += mm;
  spread.squares += mm * mm;
  if (mm < -options_.tolerance_mm) ++spread.below;
  if (mm > options_.tolerance_mm) ++spread.above;
  const double place = (mm / options_.within_mm + 1) * (0.5 * kFineBins);
  ++spread.fine[std::min(static_cast<std::size_t>(std::max(place, 0.0)), kFineBins - 1)];
  if (!std::isfinite(sigma_mm)) return;
  ++spread.with_sigma;
  spread.variances += sigma_mm * sigma_mm;
}

std::vector<double> DeviationCount::add(const Cloud& cloud) {
  std::vector<double> distances = surface_.signed_distances(cloud.points, options_.within_mm);
  const std::vector<double>* sigma_mm = cloud.field("sigma_mm");
  require(sigma_mm == nullptr || sigma_mm->size() == cloud.size(), "a field has a value at each point");
  const auto inside = membership(cloud.points, regions_);
  const double bins_per_mm = 0.5 * options_.bins / options_.histogram_mm;
  // One after the other, so that sums do not depend on how the cloud was cut.
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double sigma = sigma_mm != nullptr ? (*sigma_mm)[i] : kUnknown;
    take(spreads_[0], distances[i], sigma);
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      if (inside[r][i] != 0) take(spreads_[1 + r], distances[i], sigma);
    }
    const double bin = std::floor((distances[i] + options_.histogram_mm) * bins_per_mm);
    if (bin >= 0 && bin < options_.bins) ++histogram_[static_cast<std::size_t>(bin)];
  }
  return distances;
}

double DeviationCount::quantile(const Spread& spread, double p) const {
  const double rank = p * static_cast<double>(spread.points);
  double before = 0;
  for (std::size_t bin = 0; bin < kFineBins; ++bin) {
    const auto here = static_cast<double>(spread.fine[bin]);
    if (here == 0 || before + here < rank) {
      before += here;
      continue;
    }
    const double place = static_cast<double>(bin) + (rank - before) / here;
    const double mm = (place / (0.5 * kFineBins) - 1) * options_.within_mm;
    return std::clamp(mm, spread.lowest, spread.highest);
  }
  return spread.highest;
}

DeviationSummary DeviationCount::summary_of(const Spread& spread, const std::string& region) const {
  DeviationSummary summary;
  summary.region = region;
  summary.points = spread.points;
  summary.beyond = spread.beyond;
  if (spread.points == 0) return summary;
  const auto count = static_cast<double>(spread.points);
  summary.mean_mm = spread.sum / count;
  summary.rms_mm = std::sqrt(spread.squares / count);
  summary.sigma_mm = std::sqrt(std::max(spread.squares / count - summary.mean_mm * summary.mean_mm, 0.0));
  summary.p05_mm = quantile(spread, 0.05);
  summary.median_mm = quantile(spread, 0.5);
  summary.p95_mm = quantile(spread, 0.95);
  summary.lowest_mm = spread.lowest;
  summary.highest_mm = spread.highest;
  summary.below = static_cast<double>(spread.below) / count;
  summary.above = static_cast<double>(spread.above) / count;
  summary.in_tolerance = static_cast<double>(spread.points - spread.below - spread.above) / count;
  if (spread.with_sigma > 0) {
    summary.predicted_rms_mm = std::sqrt(spread.variances / static_cast<double>(spread.with_sigma));
  }
  return summary;
}

Deviation DeviationCount::finish() const {
  Deviation deviation;
  deviation.whole = summary_of(spreads_[0], "");
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    deviation.regions.push_back(summary_of(spreads_[1 + r], regions_[r].name));
  }
  deviation.bin_mm = 2 * options_.histogram_mm / options_.bins;
  deviation.histogram = histogram_;
  return deviation;
}

Deviation deviation_of(const Cloud& cloud, const SurfaceTree& surface, std::span<const ScanRegion> regions,
                       const DeviationOptions& options) {
  DeviationCount count(surface, regions, options);
  std::vector<double> mm = count.add(cloud);
  Deviation deviation = count.finish();
  deviation.mm = std::move(mm);
  return deviation;
}

void add_deviation(Cloud& cloud, std::vector<double> mm) {
  require(mm.size() == cloud.size(), "each point has a deviation");
  for (CloudField& field : cloud.fields) {
    if (field.name != "deviation_mm") continue;
    field.values = std::move(mm);
    return;
  }
  cloud.fields.push_back({"deviation_mm", std::move(mm)});
}

}  // namespace asterism
