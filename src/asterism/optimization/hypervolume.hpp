// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asterism {

/// Volume of what the points dominate up to `reference` (all objectives minimised; Zitzler & Thiele 1998).
/// `objectives` is count × m, row-major; dominated points and copies change nothing, and a point that is not
/// better than the reference in every objective adds nothing. Two and three objectives are swept in
/// O(n log n); more are cut into slices along the last objective, down to three (While et al. 2012).
[[nodiscard]] double hypervolume(std::span<const double> objectives, std::size_t m,
                                 std::span<const double> reference);

/// What the hypervolume would lose without each single point; `m` is 2 or 3 and the points are one front: no
/// one dominates another. A copy of another point adds nothing, nor does one beyond the reference.
/// O(n log n) (three objectives: Emmerich & Fonseca 2011).
[[nodiscard]] std::vector<double> hypervolume_contributions(std::span<const double> objectives, std::size_t m,
                                                            std::span<const double> reference);

}  // namespace asterism
