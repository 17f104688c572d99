// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/outline.hpp"

#include <cmath>
#include <numbers>

namespace asterism {

Rim rim_of_disc(const Lens& lens, const DiscPlace& disc, int points) {
  const Vec3 across = disc.normal.unitOrthogonal();
  const Vec3 along = disc.normal.cross(across);
  const double step = 2.0 * std::numbers::pi / points;
  Rim rim;
  rim.reserve(static_cast<std::size_t>(points));
  for (int i = 0; i < points; ++i) {
    const double c = disc.radius_mm * std::cos(i * step);
    const double s = disc.radius_mm * std::sin(i * step);
    const auto image = project(lens, disc.centre + c * across + s * along);
    if (!image) return {};
    rim.push_back({image->px, image->by_point * (step * (c * along - s * across))});
  }
  return rim;
}

RimMoments moments_of(const Rim& rim) {
  require(rim.size() >= 3, "a rim has three points or more");
  // About the mean of the points, so that large pixel coordinates cost no digits.
  Vec2 origin = Vec2::Zero();
  for (const RimPoint& point : rim) origin += point.px / static_cast<double>(rim.size());
  // ∮ over the cone from the origin to each step: p × dp / 2 is its area, 2/3 p its centroid, p pᵀ / 2 its
  // spread.
  double area = 0;
  Vec2 first = Vec2::Zero();
  Mat2 second = Mat2::Zero();
  for (const RimPoint& point : rim) {
    const Vec2 p = point.px - origin;
    const double cone = 0.5 * (p.x() * point.by_step.y() - p.y() * point.by_step.x());
    area += cone;
    first += cone * (2.0 / 3.0) * p;
    second += cone * 0.5 * (p * p.transpose());
  }
  const Vec2 mean = first / area;
  return {std::abs(area), ellipse_from_shape(origin + mean, 4.0 * (second / area - mean * mean.transpose()))};
}

Outline polygon_of(const Rim& rim) {
  const Vec2 centre = moments_of(rim).ellipse.centre;
  const double step = 2.0 * std::numbers::pi / static_cast<double>(rim.size());
  const double same_area = std::sqrt(step / std::sin(step));
  Outline outline;
  outline.reserve(rim.size());
  for (const RimPoint& point : rim) outline.push_back(centre + same_area * (point.px - centre));
  return outline;
}

}  // namespace asterism
