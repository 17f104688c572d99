// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/camera/lens.hpp"
#include "asterism/geometry/ellipse.hpp"

namespace asterism {

/// A flat round target in a camera's frame.
struct Disc {
  Vec3 centre;    // mm
  Vec3 normal;    // unit; either side
  double radius;  // mm; 0 = a point
};

struct DiscCentre {
  Vec2 px;          // centre of the disc's elliptical image: not the image of its centre
  Mat23 by_centre;  // ∂px / ∂centre
  Mat23 by_normal;  // ∂px / ∂normal
};

/// Centre of the image of a disc, exact for a pinhole: the dual conic of a disc is
/// C* = c cᵀ − r² (I − n nᵀ) (Heikkilä 2000; Luhmann 2014 for why it matters). Lens distortion moves
/// the centre of the ellipse by its second derivatives, which is added: good to 0.001 px.
[[nodiscard]] Result<DiscCentre, LensFailure> project_disc_centre(const Lens& lens, const Disc& disc);

/// The whole ellipse, in pixels; through distortion linearised at its centre.
[[nodiscard]] Result<Ellipse, LensFailure> image_of_disc(const Lens& lens, const Disc& disc);

/// The outline of a sphere: C* = c cᵀ − r² I.
[[nodiscard]] Result<Ellipse, LensFailure> image_of_sphere(const Lens& lens, const Vec3& centre,
                                                           double radius);

}  // namespace asterism
