// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asterism {

/// How far apart the neighbours of each point of one front lie (the paper's Equation 29; Deb et al. 2002):
/// over the objectives, the sum of (next − previous) / (largest − smallest). The first and the last point in
/// an objective are infinitely far; an objective that is the same for all says nothing and is left out.
/// Among equals in an objective the others decide who is next, so the order of the points does not matter.
class CrowdingDistance {
 public:
  /// Of the points `front` (indices into `objectives`, count × m, row-major), in the order of `front`;
  /// valid until the next call.
  std::span<const double> operator()(std::span<const double> objectives, std::size_t m,
                                     std::span<const std::uint32_t> front);

 private:
  std::vector<double> distance_;
  std::vector<std::uint32_t> order_;  // positions in `front`
};

/// The same, for once: `distance[i]` is that of `front[i]`.
void crowding_distances(std::span<const double> objectives, std::size_t m, std::span<const int> front,
                        std::span<double> distance);

}  // namespace asterism
