// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asterism {

// Fronts as row-major arrays, one row a candidate, all objectives minimised.

/// Each objective as a share of its way from the front's best to its worst; 0 where all are the same.
[[nodiscard]] std::vector<double> by_range(std::span<const double> objectives, std::size_t m);

/// The candidate whose shares (by_range) have the smallest sum: of all, it lies farthest below the plane
/// through the points where one objective is at its worst and the others at their best. The first of equals.
/// `objectives` holds at least one row.
[[nodiscard]] std::size_t knee_of(std::span<const double> objectives, std::size_t m);

/// At most `most` rows that stand for the front: the knee, the best of each objective, then again and again
/// the one farthest from those chosen (by its shares). Ascending.
[[nodiscard]] std::vector<std::size_t> thinned(std::span<const double> objectives, std::size_t m,
                                               std::size_t most);

}  // namespace asterism
