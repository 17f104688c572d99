// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// Tables 1 and 2, Figures 6 to 10.
[[nodiscard]] std::vector<Exhibit> frames_exhibits();

}  // namespace asterism
