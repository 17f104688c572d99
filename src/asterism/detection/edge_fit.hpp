// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/detection/detect.hpp"
#include "asterism/detection/edge_kernel.hpp"

namespace asterism {

/// What a fit may know beforehand of the blur.
struct BlurPrior {
  double mean = 0.75;      // px
  double deviation = 0.5;  // px; 0 = held
};

struct FitLimits {
  int iterations = 20;
  double enough_px =
      2e-3;  // a move of the outline after which no other is made: the next is 20 times smaller
};

struct EdgeFit {
  EdgeModel model;
  Mat2 covariance = Mat2::Zero();  // px², of the centre, for the noise given
  double chi_square = 0;
  double pixels = 0;
  int iterations = 0;
};

/// Maximum-likelihood fit (Levenberg–Marquardt) of the model to the usable pixels, whose variance is `noise`.
[[nodiscard]] Result<EdgeFit, FitFailure> fit_edge(const Patch& patch, const EdgeModel& start,
                                                   const EdgeProfile& profile, const EdgeNoise& noise,
                                                   const BlurPrior& blur, const FitLimits& limits = {});

/// The ellipse in image coordinates, and a model of an ellipse.
[[nodiscard]] Ellipse ellipse_of(const Patch& patch, const EdgeModel& model);
[[nodiscard]] EdgeModel model_of(const Patch& patch, const Ellipse& ellipse);

}  // namespace asterism
