// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/chapters.hpp"
#include "asterism/reproduction/disturbance.hpp"

namespace asterism {

/// Tables 13 and 14, Figures 21 to 24. `expected` are the errors of schemes 1 to 3 by the cameras' noise.
[[nodiscard]] std::vector<Exhibit> errors_exhibits(const std::vector<ExpectedErrors>& expected,
                                                   std::uint64_t seed);

}  // namespace asterism
