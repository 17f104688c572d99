// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/simulation/simulate.hpp"

namespace asterism {

/// What is true of a cell at a moment; targets of the exposure that this moment is the middle of.
[[nodiscard]] FrameTruth truth_of(const Stage& stage, double time_s);

}  // namespace asterism
