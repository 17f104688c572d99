// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "asterism/core/options.hpp"
#include "asterism/measurement/cloud.hpp"
#include "asterism/scanning/surface_samples.hpp"

namespace asterism {

struct CompletenessOptions {
  double radius_mm = 5;      // a place is measured when enough points lie so near,
  int points = 3;            // so many of them,
  double off_mm = 1;         // and no farther off the surface than this, on the right side of a thin wall
  double max_turn_deg = 60;  // between a point's normal and the place's
};
void describe(CompletenessOptions& options, OptionVisitor& visit);

/// A part of the surface that is not measured and hangs together.
struct Hole {
  double area_mm2 = 0;
  Vec3 centre = Vec3::Zero();  // mean of its places, by area
  Vec3 normal = Vec3::Zero();  // unit, mean; zero where it faces all ways, as a belt around the part does
  double across_mm = 0;        // largest distance of two of its places, about
  std::vector<std::uint32_t> samples;  // ascending
};

/// How much of a surface a cloud measures. Places of weight 0 need not be measured: they are in neither
/// area and in no hole.
struct Completeness {
  std::vector<std::uint8_t> measured;  // by sample
  std::vector<int> points;             // near it, by sample
  double surface_mm2 = 0, measured_mm2 = 0;
  std::vector<Hole> holes;  // largest first
  [[nodiscard]] double share() const { return surface_mm2 > 0 ? measured_mm2 / surface_mm2 : 0; }
};

/// Takes a cloud piece by piece, in any order; memory grows with the samples only.
/// A point p counts for a place s with normal n when
///   |p − s| ≤ radius,  |n · (p − s)| ≤ off,  and its own normal agrees with n;
/// to a point without a normal that of the place whose tangent plane is nearest is lent, so that it measures
/// one side of a thin wall, and not the other.
class CompletenessCount {
 public:
  CompletenessCount(std::span<const SurfaceSample> samples, const CompletenessOptions& options);
  void add(const Cloud& cloud);
  [[nodiscard]] Completeness finish() const;

 private:
  struct Grid;
  std::vector<SurfaceSample> samples_;
  CompletenessOptions options_;
  std::shared_ptr<const Grid> grid_;
  std::vector<int> points_;
};

/// Cloud and samples in the workpiece's frame. An empty cloud measures nothing.
[[nodiscard]] Completeness completeness_of(const Cloud& cloud, std::span<const SurfaceSample> samples,
                                           const CompletenessOptions& options);

}  // namespace asterism
