// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "asterism/detection/edge_kernel.hpp"

namespace asterism {

/// How far the pixels of one target scatter about its model, away from the edge: inside and outside.
struct Scatter {
  double outside_level = 0, outside_variance = 0, outside_pixels = 0;
  double inside_level = 0, inside_variance = 0, inside_pixels = 0;
};
[[nodiscard]] Scatter scatter_of(const Patch& patch, const std::vector<float>& distance,
                                 const EdgeModel& model);

/// Variance of a pixel against its grey level: read noise, shot noise and fixed pattern taken together as a
/// straight line, which they are to some percent between a target's background and its plateau.
/// Never below that of rounding to the grey step.
struct NoiseModel {
  double constant = 1, per_level = 0, floor = 0;
  [[nodiscard]] double variance(double level) const { return std::max(floor, constant + per_level * level); }
};

/// From all targets of an image; `step` is the grey step. Targets on a textured background, which scatter
/// far more than the rest, count little.
[[nodiscard]] NoiseModel noise_model(const std::vector<Scatter>& scatters, double step);

/// For one target: the image's noise, or its own scatter where that is clearly larger (texture).
[[nodiscard]] EdgeNoise edge_noise(const NoiseModel& noise, const Scatter& scatter, const EdgeModel& model);

}  // namespace asterism
