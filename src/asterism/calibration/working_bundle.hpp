// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/calibration/bundle.hpp"
#include "asterism/calibration/stereo_calibration.hpp"

namespace asterism {

/// The bundle and, for each of its views, the pair it came from.
struct Working {
  Bundle bundle;
  std::vector<std::size_t> pair_of;
};

/// Start, adjustment, refusal: again without each image that does not fit, until all that is left does.
/// Marks refused images in `pairs`. Throws MeasurementError when too little is left.
[[nodiscard]] Working settle(std::vector<CalibrationPair>& pairs, const CalibrationInput& input,
                             const CalibrationOptions& options, int coefficients);

/// Both lenses; coefficients beyond are set to zero.
void set_coefficients(Bundle& bundle, int coefficients);

/// Throws MeasurementError: why, then each refused image with its reason.
[[noreturn]] void give_up(const std::string& why, const std::vector<CalibrationPair>& pairs);

}  // namespace asterism
