// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/camera/image.hpp"
#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"
#include "asterism/measurement/centre.hpp"

namespace asterism {

/// Discs brighter, or darker, than what surrounds them.
enum class Polarity { Bright, Dark };

struct DetectionOptions {
  Polarity polarity = Polarity::Bright;
  double min_diameter_px = 2.5;     // smallest minor axis
  double max_diameter_px = 150;     // largest major axis
  double max_aspect = 4;            // major over minor axis; 4 is a disc tilted by 75 degrees
  double min_contrast_levels = 8;   // grey steps of the image a disc must stand out by, and
  double min_contrast_noise = 8;    // the same in standard deviations of the local noise
  double min_fill = 0.8;            // area over that of the ellipse with the same second moments
  double min_edge_support = 0.7;    // share of the outline where the grey level falls as at an edge
  double blur_px = 0;               // standard deviation of the edge's blur; 0 = fitted
  double blur_held_below_px = 2.5;  // semi-axis below which the blur is not fitted but held
};
void describe(DetectionOptions& options, OptionVisitor& visit);

/// Why an ellipse could not be fitted to an edge.
enum class FitFailure {
  OutsideImage,  // most of the window lies beyond the image
  TooFewPixels,  // too few usable pixels: saturated, hidden by neighbours, cut off
  NoContrast,    // nothing stands out from the background there
  NotConverged,  // the fit ran away from its start
};

/// All round targets of an image: threshold that follows uneven light, connected components, rejection by
/// size, shape, contrast and edge support, then for each a maximum-likelihood fit of an ellipse whose step
/// in grey level is blurred (edge_fit.hpp), weighted with the noise the image itself shows
/// (noise_model.hpp). Centres come with 2×2 covariance and flags, sorted by y.
[[nodiscard]] std::vector<Centre> detect_targets(const Image& image, const DetectionOptions& options);

/// Where a target is expected.
struct SearchWindow {
  Vec2 centre_px;
  double radius_px;
};

/// The same, looking only into windows. A target is found when it lies in a window wholly.
[[nodiscard]] std::vector<Centre> detect_targets(const Image& image, std::span<const SearchWindow> windows,
                                                 const DetectionOptions& options);

/// Fits one target whose ellipse is known to about a quarter of its size.
[[nodiscard]] Result<Centre, FitFailure> fit_target(const Image& image, const Ellipse& start,
                                                    const DetectionOptions& options);

}  // namespace asterism
