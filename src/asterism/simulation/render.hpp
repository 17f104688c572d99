// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "asterism/camera/image.hpp"
#include "asterism/simulation/stage.hpp"

namespace asterism {

/// The light that falls on one camera's sensor during the exposure around `time_s`, a share of full scale
/// for each pixel, without noise: background with its gradient, surfaces, discs by exact
/// area coverage with what hides them cut out (eighths of a pixel), averaged over the exposure, blurred by
/// the lens as their depth asks, lamps with their halos, glints, vignetting. `seed` and `frame` place the
/// glints.
[[nodiscard]] Raster<float> render_light(const Stage& stage, Side side, double time_s, std::uint64_t seed,
                                         int frame);

}  // namespace asterism
