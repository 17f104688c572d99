// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/chain_errors.hpp"
#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// Tables 13 and 14, Figures 21 to 24. `expected` are the errors of schemes 1 to 3 by the cameras' noise,
/// `errors` those of the platform over its motion.
[[nodiscard]] std::vector<Exhibit> errors_exhibits(const std::vector<ExpectedErrors>& expected,
                                                   const ChainTrace& errors, std::uint64_t seed);

}  // namespace asterism
