// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/detection/detect.hpp"
#include "asterism/detection/edge_fit.hpp"
#include "asterism/detection/edge_profile.hpp"
#include "asterism/detection/noise_model.hpp"
#include "asterism/detection/patch.hpp"

namespace asterism {

/// One target on its way from a candidate to a centre.
struct TargetFit {
  Patch patch;
  PatchContent content;
  Scatter scatter;
  EdgeNoise noise;
  BlurPrior blur;
  EdgeFit fit;
  std::uint32_t flags = 0;
};

/// What all targets of one image share.
struct ImageTraits {
  NoiseModel noise;
  double blur_px = 0.75;
  EdgeProfile profile;
  double usual_chi_square = 1;  // median over targets of the reduced χ²
};

/// Fits all pixels alike: enough to learn the image's noise and blur.
template <class Grey>
[[nodiscard]] Result<TargetFit, FitFailure> first_fit(const Raster<Grey>& image, Tone<Grey> tone,
                                                      const GreyScale& scale, const Ellipse& start,
                                                      const DetectionOptions& options);

/// Noise and blur from first fits. `step` is the grey step on the scale from 0 to 1.
[[nodiscard]] ImageTraits traits_of(std::span<const TargetFit> targets, double step,
                                    const DetectionOptions& options);

/// Fits with each pixel weighted by its noise, near the edge only; false when that does not come off.
[[nodiscard]] bool refit(TargetFit& target, const ImageTraits& traits, const DetectionOptions& options);

/// Pixels' squared residuals over their variance, on average; and the median of that over targets.
[[nodiscard]] double reduced_chi_square(const TargetFit& target);
[[nodiscard]] double median_chi_square(std::span<const TargetFit> targets);

/// Holds the outline against the fitted ellipse, sector by sector. Where part of it lies elsewhere (something
/// covers the disc) the ellipse is fitted to the rest and flagged; false when too little of it is an ellipse.
[[nodiscard]] bool judge_outline(TargetFit& target, const ImageTraits& traits);

/// The result, with the covariance widened by whatever the model does not explain.
template <class Grey>
[[nodiscard]] Centre centre_of(const TargetFit& target, Tone<Grey> tone, const GreyScale& scale);

}  // namespace asterism
