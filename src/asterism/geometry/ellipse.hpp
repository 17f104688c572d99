// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// An ellipse in an image (px) or in normalised camera coordinates.
struct Ellipse {
  Vec2 centre = Vec2::Zero();
  double semi_major = 0;
  double semi_minor = 0;
  double angle_rad = 0;  // of the major axis, from +x towards +y, in (−π/2, π/2]
};

/// The matrix S with the ellipse = {c + S^½ e, |e| = 1}: (p − c)ᵀ S⁻¹ (p − c) = 1. Its eigenvalues are
/// the squares of the semi-axes.
[[nodiscard]] Mat2 shape_matrix(const Ellipse& ellipse);
[[nodiscard]] Ellipse ellipse_from_shape(const Vec2& centre, const Mat2& shape);

/// The ellipse of a dual conic C* (3×3 symmetric, lines l with lᵀ C* l = 0 touch it; any scale).
/// Empty when the conic is not a real ellipse.
[[nodiscard]] std::optional<Ellipse> ellipse_from_dual_conic(const Mat3& dual);

}  // namespace asterism
