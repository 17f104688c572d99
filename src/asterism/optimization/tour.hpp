// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace asterism {

/// Stops to be visited once each; it need not end where it begins. What a change of group costs, such as
/// turning a platform, is part of the times.
struct TourProblem {
  std::size_t stops = 0;
  std::vector<double> time_s;          // row by row, from the row's stop to the column's; there may cost more
                                       // than back; the diagonal is not looked at
  std::optional<std::uint32_t> first;  // where it begins; else anywhere
};

struct Tour {
  std::vector<std::uint32_t> order;
  double length_s = 0;
  double nearest_length_s = 0;  // of always going to the nearest stop, from `first` or the best beginning
};

/// A short order to visit the stops in: from the better of nearest neighbour and cheapest insertion,
/// stretches are moved and turned (Or-opt, 2-opt with the way back counted as such) until none helps, then
/// again after two neighbouring stretches changed places at random (Martin, Otto & Felten 1991). Always the
/// same for the same problem; not proven shortest. Throws InputError for times that are missing, negative or
/// no numbers.
[[nodiscard]] Tour short_tour(const TourProblem& problem);

}  // namespace asterism
