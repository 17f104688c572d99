// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// Figures 11 and 20.
[[nodiscard]] std::vector<Exhibit> motion_exhibits();

}  // namespace asterism
