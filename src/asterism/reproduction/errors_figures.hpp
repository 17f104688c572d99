// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// Tables 13 and 14, Figures 21 to 24.
[[nodiscard]] std::vector<Exhibit> errors_exhibits(std::uint64_t seed);

}  // namespace asterism
