// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/scan_coverage.hpp"

#include <cmath>
#include <utility>

#include "asterism/cell/solid.hpp"
#include "asterism/core/result.hpp"
#include "asterism/optimization/set_cover.hpp"
#include "asterism/scanning/measurability.hpp"

namespace asterism {
namespace {

constexpr std::size_t kSamples = 4000, kViews = 2000;
constexpr std::uint64_t kSeed = 26;
constexpr double kMaxTiltRad = 0.6;  // of a view from the normal: 35°

/// The shape's foot at `foot_mm`.
ScannedPart part_of(std::string name, const CasingShape& shape, double foot_mm) {
  const TriangleMesh surface = moved(mesh_of(shape), {Quaternion::Identity(), {0, 0, foot_mm}});
  ScannedPart part{std::move(name), RayScene(surface), sample_surface(surface, kSamples, {}, kSeed), {}};
  const double slope = (shape.top_radius_mm - shape.bottom_radius_mm) / shape.height_mm;
  for (const SurfaceSample& sample : part.samples) {
    const double height_mm = sample.at.z() - foot_mm;
    const double wall_mm = shape.bottom_radius_mm + slope * height_mm;
    const double radius_mm = std::hypot(sample.at.x(), sample.at.y());
    part.outer.push_back(radius_mm > wall_mm - 0.5 && height_mm > 0.5 && height_mm < shape.height_mm - 0.5);
  }
  return part;
}

BitRows rows_of(const ScannedPart& part, std::span<const Viewpoint> stations) {
  return measured_samples(stations, part.samples, Scanner{}, part.surface, {});
}

double share(const ScannedPart& part, std::span<const std::uint8_t> measured, bool outer_only) {
  double area = 0, covered = 0;
  for (std::size_t i = 0; i < part.samples.size(); ++i) {
    if (outer_only && part.outer[i] == 0) continue;
    area += part.samples[i].area_mm2;
    if (measured[i] != 0) covered += part.samples[i].area_mm2;
  }
  return covered / area;
}

}  // namespace

ScannedPart bare_cone() {
  constexpr double kSlope = 0.1208, kFootMm = -115;
  CasingShape shape;
  shape.height_mm = 600;
  shape.bottom_radius_mm += kSlope * kFootMm;
  shape.top_radius_mm = shape.bottom_radius_mm + kSlope * shape.height_mm;
  shape.flange_width_mm = 0;
  shape.bosses = 0;
  return part_of("bare cone", shape, kFootMm);
}

ScannedPart flanged_casing() { return part_of("casing with flanges and bosses", {}, 0); }

std::vector<std::uint8_t> measured_from(const ScannedPart& part, std::span<const Viewpoint> stations) {
  const BitRows rows = rows_of(part, stations);
  std::vector<std::uint8_t> measured(part.samples.size(), 0);
  for (std::size_t view = 0; view < rows.rows(); ++view) {
    for_each_bit(rows.row(view), [&](std::size_t sample) { measured[sample] = 1; });
  }
  return measured;
}

std::vector<std::uint8_t> either(std::vector<std::uint8_t> a, const std::vector<std::uint8_t>& b) {
  require(a.size() == b.size(), "both tell of the same samples");
  for (std::size_t i = 0; i < a.size(); ++i) a[i] |= b[i];
  return a;
}

double share_of_outer(const ScannedPart& part, std::span<const std::uint8_t> measured) {
  return share(part, measured, true);
}

double share_of_whole(const ScannedPart& part, std::span<const std::uint8_t> measured) {
  return share(part, measured, false);
}

FewestViews fewest_views_of_outer_wall(const ScannedPart& part) {
  std::vector<SurfaceSample> outer;
  for (std::size_t i = 0; i < part.samples.size(); ++i) {
    if (part.outer[i] != 0) outer.push_back(part.samples[i]);
  }
  const auto views = views_of_surface(outer, kViews, Scanner{}.stand_off_mm, kMaxTiltRad, kSeed);
  const BitRows rows = measured_samples(views, outer, Scanner{}, part.surface, {});
  SetCoverProblem problem;
  problem.rows = outer.size();
  problem.share = 0.99;
  for (const SurfaceSample& sample : outer) problem.weight.push_back(sample.area_mm2);
  for (std::size_t view = 0; view < rows.rows(); ++view) {
    auto& column = problem.columns.emplace_back();
    for_each_bit(rows.row(view),
                 [&](std::size_t sample) { column.push_back(static_cast<std::uint32_t>(sample)); });
  }
  SetCoverOptions options;
  options.exact_s = 0;  // benchmarks/plan_bench.cpp asks the exact part too, and searches longer
  options.local_steps = 6000;
  const SetCover cover = solve(problem, options, kSeed, no_progress);
  double area = 0;
  for (const SurfaceSample& sample : outer) area += sample.area_mm2;
  return {cover.chosen.size(), static_cast<std::size_t>(std::lround(cover.bound)), cover.covered / area};
}

}  // namespace asterism
