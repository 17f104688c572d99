// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// Distances between all points, row by row.
[[nodiscard]] std::vector<double> distances_of(std::span<const Vec3> points);

struct PointPair {
  double distance;
  std::size_t first, second;  // first < second
  [[nodiscard]] auto operator<=>(const PointPair&) const = default;
};

/// Every two points, nearest first.
[[nodiscard]] std::vector<PointPair> pairs_by_distance(std::span<const Vec3> points);

}  // namespace asterism
