// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/reproduction/verdict.hpp"

namespace asterism {

/// The paper's Table 3, step by step, with its comparisons of two objective values counted.
struct CountedSort {
  std::vector<int> rank;  // 0 = Front 1
  long long comparisons = 0;
};
[[nodiscard]] CountedSort sort_as_table3(std::span<const double> objectives, std::size_t m);

/// Table 3 against the sort in use, its O(N²), and whether Section 3.2's objectives are in conflict.
[[nodiscard]] std::vector<LedgerRow> rows_of_sorting(std::uint64_t seed);

}  // namespace asterism
