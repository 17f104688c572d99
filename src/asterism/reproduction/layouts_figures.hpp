// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/chapters.hpp"
#include "asterism/reproduction/schemes.hpp"

namespace asterism {

/// Tables 9 to 12, Figures 12, 13, 17, 18 and 19.
[[nodiscard]] std::vector<Exhibit> layouts_exhibits(const std::vector<Scheme>& schemes, std::uint64_t seed);

}  // namespace asterism
