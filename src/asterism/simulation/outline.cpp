// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/outline.hpp"

#include <cmath>
#include <numbers>

namespace asterism {

Outline outline_of_disc(const Lens& lens, const DiscPlace& disc, int corners) {
  const Vec3 across = disc.normal.unitOrthogonal();
  const Vec3 along = disc.normal.cross(across);
  const double step = 2.0 * std::numbers::pi / corners;
  const double same_area = std::sqrt(step / std::sin(step));
  Outline outline;
  outline.reserve(static_cast<std::size_t>(corners));
  for (int i = 0; i < corners; ++i) {
    const double angle = i * step;
    const Vec3 rim =
        disc.centre + disc.radius_mm * same_area * (std::cos(angle) * across + std::sin(angle) * along);
    const auto image = project(lens, rim);
    if (!image) return {};
    outline.push_back(image->px);
  }
  return outline;
}

OutlineMoments moments_of(const Outline& outline) {
  require(outline.size() >= 3, "an outline has three corners or more");
  // About the first corner, so that large pixel coordinates cost no digits.
  const Vec2 origin = outline.front();
  double area = 0;
  Vec2 first = Vec2::Zero();
  Mat2 second = Mat2::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - origin;
    const Vec2 b = outline[(i + 1) % outline.size()] - origin;
    const double cross = a.x() * b.y() - b.x() * a.y();
    area += cross / 2;
    first += cross / 6 * (a + b);
    second += cross / 24 * ((a + b) * (a + b).transpose() + a * a.transpose() + b * b.transpose());
  }
  const Vec2 mean = first / area;
  const Mat2 spread = second / area - mean * mean.transpose();
  return {std::abs(area), ellipse_from_shape(origin + mean, 4.0 * spread)};
}

}  // namespace asterism
