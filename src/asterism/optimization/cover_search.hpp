// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/optimization/cover_model.hpp"

namespace asterism {

/// Looks for a cheaper cover near a given one, by so many steps of row weighting (Gao, Weise & Li 2015): a
/// step takes out the column that is missed least, then puts in what covers a row at random best, as far as
/// the cost stays below the best known; rows that stay uncovered grow heavier (one of them
/// where a share will do). A column taken out comes back
/// only after something changed beside it. Stops early at a cover that costs no more than `bound`. Never
/// worse than the start.
[[nodiscard]] std::vector<std::uint32_t> searched_cover(const CoverModel& model,
                                                        std::span<const std::uint32_t> start, int steps,
                                                        double bound, std::uint64_t seed,
                                                        const Progress& progress);

}  // namespace asterism
