// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "asterism/measurement/cloud.hpp"

namespace asterism {

/// The points of a cloud that a page draws.
struct DisplayCloud {
  std::vector<std::uint32_t> points;  // places in the cloud, ascending
  double voxel_mm = 0;                // one point was kept of each such cube and facing; 0 = all are drawn
};

/// At most `most` of the cloud's finite points, spread evenly, for drawing only: of those that lie in one
/// cube of a grid and face the same way (both sides of a thin wall stay) the one nearest to the cube's
/// middle. They are points of the cloud, not means: whatever is known of each stays true.
[[nodiscard]] DisplayCloud thinned(const Cloud& cloud, std::size_t most);

/// Where each point of `points` is, in steps from `low`: 16 bits an axis.
struct PackedPlaces {
  Vec3 low = Vec3::Zero();  // mm
  double step_mm = 1;       // half of it is the largest error
  std::vector<std::uint16_t> steps;
};
[[nodiscard]] PackedPlaces packed_places(const Cloud& cloud, const std::vector<std::uint32_t>& points);

/// IEEE half floats, of three to four digits; NaN for what is not finite or too large for them.
[[nodiscard]] std::vector<std::uint16_t> packed_reals(const std::vector<double>& values,
                                                      const std::vector<std::uint32_t>& points);
/// Counts and numbers; 65535 for what is none, 65534 for that many or more.
[[nodiscard]] std::vector<std::uint16_t> packed_counts(const std::vector<double>& values,
                                                       const std::vector<std::uint32_t>& points);

}  // namespace asterism
