// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/evaluation/speed_trade.hpp"

namespace asterism {

/// The cell with its verified body swinging about its pivot from its place of rest, so fast at the fastest;
/// it passes its place of rest at time 0.
[[nodiscard]] Cell swinging_cell(const Cell& cell, double speed_deg_s, double swing_deg);

/// Images of the swing at exposures that smear a target by 0 to 1.5 of its diameters, detected and held
/// against where the targets' images truly are at the middle of the exposure.
[[nodiscard]] std::vector<StreakCheck> streak_checks(const Cell& cell, const SpeedTradeOptions& options,
                                                     const DetectionOptions& detection);

}  // namespace asterism
