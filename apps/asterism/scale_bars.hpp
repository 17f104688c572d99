// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/calibration/bundle.hpp"

namespace asterism::app {

/// Each of `given` reads RECORDING=length_mm[,sigma_mm] (sigma 0.01 mm when it is not told): a recording of a
/// bar with two targets. In each frame the one pair of points whose distance by `rig` is within 2 % of the
/// length becomes an observation; frames with none or several are passed over. Throws InputError for a text
/// that reads otherwise, MeasurementError when no frame of a recording shows the bar.
[[nodiscard]] std::vector<ScaleBarView> find_scale_bars(const std::vector<std::string>& given,
                                                        const StereoRig& rig);

}  // namespace asterism::app
