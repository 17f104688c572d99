// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/evaluation/robustness.hpp"

// The trade of the paper's Section 6: error over angular speed × exposure × frame rate, raw and filtered.

namespace asterism {

struct SpeedTradeOptions {
  std::uint64_t seed = 1;
  std::vector<double> speeds_deg_s = {0, 10, 30, 60, 120, 180};  // at the swing's fastest
  std::vector<double> exposures_s = {0.0005, 0.001, 0.002, 0.005, 0.01};
  std::vector<double> rates_hz = {10, 30, 60, 100};
  double swing_deg = 15;  // to either side about the platform's x axis, at most its stroke
  int frames = 18;        // of each of two runs: through the fastest moment, and through a turning point
  int image_frames = 3;   // for each streak checked on images; 0 = none
  double longest_streak = 0.5;  // of a disc's diameter: what is smeared further is not reliably found
};
void describe(SpeedTradeOptions& options, OptionVisitor& visit);

struct SpeedTradeRow {
  double speed_deg_s = 0, exposure_s = 0, rate_hz = 0;
  double streak_px = 0;  // mean way of a target's image during the exposure
  double sigma_px = 0;   // RMS of a centre's deviation along an axis
  Outcome measured, filtered;
};

/// Detection on images of the same swing beside the model of a moving disc's centre.
struct StreakCheck {
  double streak_px = 0, exposure_s = 0;  // means over the centres
  std::size_t shown = 0, found = 0;      // discs in the images, and centres detected at their places
  double along_px = 0, across_px = 0;    // RMS errors of those, along and across the streak
  double stated_px = 0;                  // RMS of the deviation that detection stated, along an axis
  double nees_share = 0;                 // mean of eᵀ C⁻¹ e / 2
  double model_along_px = 0, model_across_px = 0;  // errors at rest grown by the bound (blurred_centre.hpp)
};

struct SpeedTrade {
  std::vector<SpeedTradeRow> rows;  // speed by speed, then exposure, then rate
  std::vector<StreakCheck> checks;  // none without images
  SpeedTradeOptions options;
};

/// The cell's verified body swings about its pivot from its place of rest; a target keeps its brightness
/// whatever the exposure (the lamps or the gain follow it). Centres have the noise model's deviation at
/// rest, grown by their streak as its Cramér–Rao bound grows.
[[nodiscard]] SpeedTrade speed_trade_of(const Cell& cell, const SpeedTradeOptions& options,
                                        const TrackerOptions& tracker, const Progress& progress);

}  // namespace asterism
