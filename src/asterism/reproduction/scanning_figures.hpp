// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// The stations of Tables 15 and 16.
[[nodiscard]] std::vector<Exhibit> scanning_exhibits();

}  // namespace asterism
