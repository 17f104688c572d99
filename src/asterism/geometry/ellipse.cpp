// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/ellipse.hpp"

#include <cmath>

namespace asterism {

Mat2 shape_matrix(const Ellipse& ellipse) {
  const double c = std::cos(ellipse.angle_rad);
  const double s = std::sin(ellipse.angle_rad);
  const double a2 = ellipse.semi_major * ellipse.semi_major;
  const double b2 = ellipse.semi_minor * ellipse.semi_minor;
  Mat2 shape;
  shape << c * c * a2 + s * s * b2, c * s * (a2 - b2), c * s * (a2 - b2), s * s * a2 + c * c * b2;
  return shape;
}

Ellipse ellipse_from_shape(const Vec2& centre, const Mat2& shape) {
  const double mean = 0.5 * (shape(0, 0) + shape(1, 1));
  const double half_difference = 0.5 * (shape(0, 0) - shape(1, 1));
  const double spread = std::hypot(half_difference, shape(0, 1));
  return {centre, std::sqrt(mean + spread), std::sqrt(std::max(0.0, mean - spread)),
          0.5 * std::atan2(shape(0, 1), half_difference)};
}

std::optional<Ellipse> ellipse_from_dual_conic(const Mat3& dual) {
  if (!dual.allFinite() || dual(2, 2) == 0) return std::nullopt;
  const Mat3 unit = dual / dual(2, 2);
  const Vec2 centre = unit.topRightCorner<2, 1>();
  const Mat2 shape = centre * centre.transpose() - unit.topLeftCorner<2, 2>();
  if (!(shape(0, 0) > 0) || !(shape.determinant() > 0)) return std::nullopt;
  return ellipse_from_shape(centre, shape);
}

}  // namespace asterism
