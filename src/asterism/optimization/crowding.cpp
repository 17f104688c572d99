// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/crowding.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "asterism/core/result.hpp"

namespace asterism {

std::span<const double> CrowdingDistance::operator()(std::span<const double> objectives, std::size_t m,
                                                     std::span<const std::uint32_t> front) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  distance_.assign(front.size(), front.size() == 1 ? kInfinite : 0.0);
  order_.resize(front.size());
  std::iota(order_.begin(), order_.end(), 0U);
  const auto value = [&](std::uint32_t at, std::size_t k) { return objectives[front[at] * m + k]; };
  for (std::size_t k = 0; k < m; ++k) {
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      for (std::size_t step = 0; step < m; ++step) {
        const std::size_t other = (k + step) % m;
        if (value(a, other) != value(b, other)) return value(a, other) < value(b, other);
      }
      return front[a] < front[b];
    };
    // A front of two objectives that comes sorted by the first is sorted by the second when reversed.
    if (!std::ranges::is_sorted(order_, before)) std::ranges::reverse(order_);
    if (!std::ranges::is_sorted(order_, before)) std::ranges::sort(order_, before);
    if (front.size() < 2) continue;
    const double range = value(order_.back(), k) - value(order_.front(), k);
    if (!(range > 0)) continue;
    distance_[order_.front()] = kInfinite;
    distance_[order_.back()] = kInfinite;
    for (std::size_t i = 1; i + 1 < order_.size(); ++i)
      distance_[order_[i]] += (value(order_[i + 1], k) - value(order_[i - 1], k)) / range;
  }
  return distance_;
}

void crowding_distances(std::span<const double> objectives, std::size_t m, std::span<const int> front,
                        std::span<double> distance) {
  require(front.size() == distance.size(), "each point of the front has its distance");
  CrowdingDistance crowding;
  const std::vector<std::uint32_t> indices(front.begin(), front.end());
  std::ranges::copy(crowding(objectives, m, indices), distance.begin());
}

}  // namespace asterism
