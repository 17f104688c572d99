// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/verdict.hpp"
#include "asterism/statistics/intervals.hpp"
#include "asterism/statistics/student.hpp"

namespace asterism {

/// Table 14's interval of scheme `scheme` (from 0), mm, and the sample of 50 runs it tells of.
[[nodiscard]] Interval interval_of_table14(std::size_t scheme);
[[nodiscard]] Summary sample_of_table14(std::size_t scheme);

/// Student's test of two schemes by what Table 14 tells of them, as independent samples.
[[nodiscard]] TTest test_of_table14(std::size_t a, std::size_t b);

/// Smallest eigenvalue of the correlations between the schemes' runs that the printed p-values would need
/// as two-sided paired tests; below zero no such runs exist.
[[nodiscard]] double eigenvalue_of_needed_correlations();

/// Table 14, Figures 23 and 24 and what Section 4.3 concludes from them.
[[nodiscard]] std::vector<LedgerRow> rows_of_comparisons();

}  // namespace asterism
