// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "asterism/core/options.hpp"
#include "asterism/measurement/cloud.hpp"
#include "asterism/scanning/surface_samples.hpp"

namespace asterism {

struct CompletenessOptions {
  double radius_mm = 5;      // a place is measured when enough points lie so near,
  int points = 3;            // so many of them,
  double off_mm = 1;         // and no farther off the surface than this, on the right side of a thin wall
  double max_turn_deg = 60;  // between a point's normal, where it has one, and the place's
};
void describe(CompletenessOptions& options, OptionVisitor& visit);

/// A part of the surface that is not measured and hangs together.
struct Hole {
  double area_mm2 = 0;
  Vec3 centre = Vec3::Zero();  // mean of its places, by area
  Vec3 normal = Vec3::Zero();  // unit, mean
  double across_mm = 0;        // largest distance of two of its places, about
  std::vector<std::uint32_t> samples;
};

/// How much of a surface a cloud measures.
struct Completeness {
  std::vector<std::uint8_t> measured;  // by sample
  std::vector<int> points;             // near it, by sample
  double surface_mm2 = 0, measured_mm2 = 0;
  std::vector<Hole> holes;  // largest first
  [[nodiscard]] double share() const { return surface_mm2 > 0 ? measured_mm2 / surface_mm2 : 0; }
};

/// Cloud and samples in the workpiece's frame. An empty cloud measures nothing.
[[nodiscard]] Completeness completeness_of(const Cloud& cloud, std::span<const SurfaceSample> samples,
                                           const CompletenessOptions& options);

}  // namespace asterism
