// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/layout/target_loss.hpp"
#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// Figure 14, from draws of the three schemes.
[[nodiscard]] std::vector<Exhibit> losses_exhibits(const std::vector<std::vector<LossDraw>>& draws,
                                                   const std::vector<LossFigures>& drawn,
                                                   const std::vector<LossExpectation>& expected);

}  // namespace asterism
