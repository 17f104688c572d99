// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/simulation/simulate.hpp"

namespace asterism {

/// The centres a detector would find in one camera's image, without making the image: those of targets
/// seen whole and not too obliquely, with normal noise, less random dropouts and those that the cell's noise
/// takes from both cameras, plus clutter; in random order, so that nothing can be read from it.
[[nodiscard]] std::vector<Centre> simulate_centres(const Cell& cell, const FrameTruth& truth, Side side,
                                                   int frame, const SimulationOptions& options);

}  // namespace asterism
