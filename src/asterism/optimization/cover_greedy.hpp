// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/optimization/cover_model.hpp"

namespace asterism {

/// Again and again the column that adds most for its cost (Chvátal 1979) until enough is covered. A column's
/// gain never grows, so only the one that seems best is looked at again (Minoux 1978). Each missing cover of
/// a row counts alike where all must be covered, by its weight where a share will do.
[[nodiscard]] std::vector<std::uint32_t> greedy_cover(const CoverModel& model);

/// The same choice among `columns` only, to the last that adds anything: the order of what each adds.
[[nodiscard]] std::vector<std::uint32_t> in_order_of_gain(const CoverModel& model,
                                                          std::span<const std::uint32_t> columns);

/// Leaves out what a cover need not have, the dearest first, then the earliest.
[[nodiscard]] std::vector<std::uint32_t> without_needless(const CoverModel& model,
                                                          std::span<const std::uint32_t> cover);

}  // namespace asterism
