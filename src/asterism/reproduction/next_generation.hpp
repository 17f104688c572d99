// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "asterism/reproduction/schemes.hpp"
#include "asterism/reproduction/verdict.hpp"

// The genetic step of the paper's Section 4.2: what parents its tournament picks and what children they have.

namespace asterism {

/// (f1, f2) of children of the five schemes by one crossover and mutation of Tables 5 and 6, each coordinate
/// bounded by ± `bound_mm`.
[[nodiscard]] std::vector<std::array<double, 2>> children_of_table9(double bound_mm, std::size_t count,
                                                                    std::uint64_t seed);

/// Can Table 11's first row be a child of the five schemes?
[[nodiscard]] LedgerRow row_of_reach(std::uint64_t seed);
/// Can its second row, which lies near S1?
[[nodiscard]] LedgerRow row_of_small_child(std::uint64_t seed);

/// How probable it is that one binary tournament (rank, then crowding; ties drawn) picks each scheme.
[[nodiscard]] std::vector<double> tournament_odds(const std::vector<Scheme>& schemes);

/// Five tournaments as drawn here (Figure 19), by index.
[[nodiscard]] std::vector<std::size_t> draw_parents(const std::vector<Scheme>& schemes, std::uint64_t seed);

/// Fig. 19, Eq. 30 and the settings of the operators.
[[nodiscard]] std::vector<LedgerRow> rows_of_operators(const std::vector<Scheme>& schemes);

}  // namespace asterism
