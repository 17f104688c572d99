// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/camera/lens.hpp"
#include "asterism/geometry/ellipse.hpp"

namespace asterism {

/// A flat disc in a camera's frame, as simulation sees it.
struct DiscPlace {
  Vec3 centre;  // mm
  Vec3 normal;  // unit
  double radius_mm;
};

/// The image of a disc's rim at even steps of the angle around it: through the whole lens model point by
/// point, with no conic and no linearisation, so that it can judge those. The rim is smooth and closed, so
/// sums over its points are integrals around it to all digits (the trapezoidal rule).
struct RimPoint {
  Vec2 px;
  Vec2 by_step;  // ∂px / ∂angle · step: from one point to the next
};
using Rim = std::vector<RimPoint>;

/// Empty when part of the rim is behind the camera.
[[nodiscard]] Rim rim_of_disc(const Lens& lens, const DiscPlace& disc, int points = 96);

/// Area, centroid and second moments by Green's theorem, told as the ellipse that has the same: for the
/// image of a disc, its ellipse.
struct RimMoments {
  double area_px2;
  Ellipse ellipse;
};
[[nodiscard]] RimMoments moments_of(const Rim& rim);

/// A closed polygon in an image, px.
using Outline = std::vector<Vec2>;

/// The polygon through the rim's points, pushed out so that it has the rim's area.
[[nodiscard]] Outline polygon_of(const Rim& rim);

}  // namespace asterism
