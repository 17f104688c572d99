// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// The mean of one point or more.
[[nodiscard]] Vec3 centroid_of(std::span<const Vec3> points);

/// Distances between all points, row by row.
[[nodiscard]] std::vector<double> distances_of(std::span<const Vec3> points);

struct SpacedPair {
  double distance;
  std::size_t first, second;  // first < second
  [[nodiscard]] auto operator<=>(const SpacedPair&) const = default;
};

/// Every two points, nearest first.
[[nodiscard]] std::vector<SpacedPair> pairs_by_distance(std::span<const Vec3> points);

}  // namespace asterism
