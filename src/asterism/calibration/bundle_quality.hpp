// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/calibration/bundle.hpp"

namespace asterism {

/// Adjusts with the variance component estimated: the points' covariances plus model_sigma² on each axis
/// make χ² equal its degrees of freedom. Sets bundle.model_sigma_px (0 when the points alone explain it).
[[nodiscard]] bool adjust_with_model_sigma(Bundle& bundle);

/// χ² over degrees of freedom at the bundle's own weights.
[[nodiscard]] double variance_factor(const Bundle& bundle);

/// RMS of the residuals' lengths; of the pairs seen by both cameras only.
[[nodiscard]] double stereo_rms(const Bundle& bundle);

/// RMS of one image's residuals; `view` counts the bundle's views. 0 when that camera has none.
struct ImageRms {
  double left_px = 0, right_px = 0;
};
[[nodiscard]] std::vector<ImageRms> image_rms(const Bundle& bundle);

/// Takes out points further off than `sigmas` of their whitened residual; returns how many.
int drop_outliers(Bundle& bundle, double sigmas);

/// RMS over pairs predicted by rigs that were adjusted without them, in `folds` groups.
[[nodiscard]] double held_out_rms(const Bundle& bundle, int folds);

/// Largest angle between the board's normals of two views seen by one camera or the other, rad.
[[nodiscard]] double largest_tilt_rad(const Bundle& bundle);

/// How far the board's points lie off their stated grid on average over the views, in the board's plane
/// (RMS, mm), beside what the residuals' noise alone would give.
struct BoardForm {
  double off_grid_mm = 0, noise_mm = 0;
};
[[nodiscard]] BoardForm board_form(const Bundle& bundle);

}  // namespace asterism
