// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/camera/image.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/types.hpp"

namespace asterism {

enum class CornerFailure { OutsideImage, SquareTooSmall, NoContrast, NoConvergence };

/// Where a corner is sought: within a few px of it, and how one square lies there in the image.
struct CornerStart {
  Vec2 px;
  Mat2 px_by_square;  // columns: the image of one step along the board's x and y
};

struct CornerFit {
  Vec2 px;
  Mat2 covariance;   // px², from the residuals
  double blur_px;    // standard deviation of the edge's blur
  double amplitude;  // half the contrast, grey levels
};

/// Maximum-likelihood fit of a chessboard corner: the product of two blurred straight edges under a light
/// that varies linearly,
///   I(p) = (b + a · erf(n₁·(p − c) / √2σ) · erf(n₂·(p − c) / √2σ)) · (1 + g·(p − c)),
/// nine parameters, over the pixels within `reach` squares of the corner (a parallelogram that follows
/// the board's tilt). A homography keeps the edges straight, so tilt brings no bias; the plain gradient
/// iteration (cornerSubPix) uses only part of the edges' information and is about three times as noisy.
[[nodiscard]] Result<CornerFit, CornerFailure> fit_corner(const Image& image, const CornerStart& start,
                                                          double reach = 0.45);

}  // namespace asterism
