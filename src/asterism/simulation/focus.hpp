// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "asterism/cell/cell.hpp"

namespace asterism {

/// σ of the spot that a point at this depth makes, px: the lens's own blur and the circle of confusion
///   c = f · aperture · |z − focus| / (z · focus),
/// an even disc of diameter c (thin lens, far beyond its focal length), whose spread along an axis is c / 4.
[[nodiscard]] inline double spot_sigma_px(const Sensor& sensor, const Lens& lens, double depth_mm) {
  if (sensor.focus_mm <= 0 || depth_mm <= 0) return sensor.blur_px;
  const double confusion_px =
      lens.fx * sensor.aperture_mm * std::abs(depth_mm - sensor.focus_mm) / (depth_mm * sensor.focus_mm);
  return std::hypot(sensor.blur_px, confusion_px / 4);
}

}  // namespace asterism
