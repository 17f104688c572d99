// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/camera/lens.hpp"
#include "asterism/geometry/ellipse.hpp"

namespace asterism {

/// A closed polygon in an image, px.
using Outline = std::vector<Vec2>;

/// A flat disc in a camera's frame, as simulation sees it.
struct DiscPlace {
  Vec3 centre;  // mm
  Vec3 normal;  // unit
  double radius_mm;
};

/// The image of a disc's rim, point by point through the whole lens model: no conic and no linearisation,
/// so that it can judge those. `corners` points evenly spaced in angle, pushed out so that the polygon has
/// the circle's area; with 512 of them it departs from the curve by 3e-5 of the radius. Empty when part of
/// the rim is behind the camera.
[[nodiscard]] Outline outline_of_disc(const Lens& lens, const DiscPlace& disc, int corners = 512);

/// Area, centroid and second moments of a polygon (Green's theorem), told as the ellipse that has the
/// same: for the image of a disc, its ellipse.
struct OutlineMoments {
  double area_px2;
  Ellipse ellipse;
};
[[nodiscard]] OutlineMoments moments_of(const Outline& outline);

}  // namespace asterism
