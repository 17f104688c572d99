// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asterism/simulation/coverage.hpp"

namespace asterism {
namespace {

constexpr int kRimPoints = 96;
constexpr int kTile_px = 32;

std::vector<Vec3> circle(const Vec3& centre, const Vec3& normal, double radius_mm) {
  const Vec3 across = normal.unitOrthogonal();
  const Vec3 along = normal.cross(across);
  std::vector<Vec3> points;
  for (int i = 0; i < kRimPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRimPoints;
    points.push_back(centre + radius_mm * (std::cos(angle) * across + std::sin(angle) * along));
  }
  return points;
}

/// Where sight lines from `camera` touch a ball.
std::vector<Vec3> contour(const Vec3& centre, double radius_mm, const Vec3& camera) {
  const Vec3 way = camera - centre;
  const double ratio = radius_mm / way.norm();
  if (ratio >= 1) return {camera};
  return circle(centre + ratio * ratio * way, way.normalized(), radius_mm * std::sqrt(1 - ratio * ratio));
}

// Points whose hull, seen from `camera`, is the solid's outline; in the solid's frame.
std::vector<Vec3> rim_of(const Box& box, const Vec3&) {
  std::vector<Vec3> points;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                    (corner & 4) != 0 ? 0.5 : -0.5);
    points.push_back(sign.cwiseProduct(box.size_mm));
  }
  return points;
}
std::vector<Vec3> rim_of(const Capsule& capsule, const Vec3& camera) {
  std::vector<Vec3> points = contour(capsule.from_mm, capsule.radius_mm, camera);
  const std::vector<Vec3> other = contour(capsule.to_mm, capsule.radius_mm, camera);
  points.insert(points.end(), other.begin(), other.end());
  return points;
}
std::vector<Vec3> rim_of(const Frustum& cone, const Vec3&) {
  std::vector<Vec3> points = circle(Vec3::Zero(), Vec3::UnitZ(), cone.bottom_radius_mm);
  const std::vector<Vec3> top = circle({0, 0, cone.height_mm}, Vec3::UnitZ(), cone.top_radius_mm);
  points.insert(points.end(), top.begin(), top.end());
  return points;
}

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Convex hull by Andrew's monotone chain.
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vec2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Vec2& point : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Straight edges become curves in the lens: each is divided finely enough to follow them.
Outline through_lens(const Lens& lens, const std::vector<Vec2>& hull) {
  constexpr double kPiece = 0.01;  // of the focal length
  Outline outline;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2& a = hull[i];
    const Vec2& b = hull[(i + 1) % hull.size()];
    const int pieces = lens.coefficients == 0 ? 1 : static_cast<int>(std::ceil((b - a).norm() / kPiece));
    for (int k = 0; k < std::max(1, pieces); ++k) {
      const Vec2 xy = a + (b - a) * (static_cast<double>(k) / std::max(1, pieces));
      outline.push_back(pixel_from_normalised(lens, distort(lens, xy).xy));
    }
  }
  return outline;
}

/// Paints one tile of the image; cheap where the outline does not pass nearby.
void paint_tile(Raster<float>& light, const Outline& outline, int x0, int y0, double level, double blur_px) {
  const int reach = static_cast<int>(std::ceil(4 * blur_px)) + 1;
  const int wide = std::min(kTile_px, light.width - x0);
  const int high = std::min(kTile_px, light.height - y0);
  FineGrid grid(x0 - reach, y0 - reach, wide + 2 * reach, high + 2 * reach, 1);
  add_coverage(grid, outline, 1.0);
  const auto [least, most] = std::minmax_element(grid.values.begin(), grid.values.end());
  if (*most < 1e-9) return;
  if (*least < 1 - 1e-9) blur(grid, blur_px);
  for (int j = 0; j < high; ++j) {
    const double* share = grid.row(j + reach) + reach;
    float* row = light.row(y0 + j) + x0;
    for (int i = 0; i < wide; ++i) row[i] += static_cast<float>(share[i] * (level - row[i]));
  }
}

void paint(Raster<float>& light, const Outline& outline, double level, double blur_px) {
  Vec2 low = outline.front();
  Vec2 high = outline.front();
  for (const Vec2& px : outline) {
    low = low.cwiseMin(px);
    high = high.cwiseMax(px);
  }
  const double reach = std::ceil(4 * blur_px) + 1;
  for (int y = 0; y < light.height; y += kTile_px) {
    if (y + kTile_px < low.y() - reach || y > high.y() + reach) continue;
    for (int x = 0; x < light.width; x += kTile_px) {
      if (x + kTile_px < low.x() - reach || x > high.x() + reach) continue;
      paint_tile(light, outline, x, y, level, blur_px);
    }
  }
}

}  // namespace

Outline outline_of_solid(const Lens& lens, const SceneSolid& solid) {
  const RigidMotion camera_from_shape = solid.shape_from_camera.inverse();
  const Vec3& camera = solid.shape_from_camera.translation;
  std::vector<Vec2> seen;
  for (const Vec3& point :
       std::visit([&](const auto& shape) { return rim_of(shape, camera); }, solid.shape)) {
    const Vec3 in_camera = camera_from_shape * point;
    if (!(in_camera.z() > 1)) return {};
    seen.push_back(in_camera.hnormalized());
  }
  return through_lens(lens, hull_of(std::move(seen)));
}

void paint_silhouettes(Raster<float>& light, const Scene& scene, const Lens& lens, double blur_px) {
  std::vector<const SceneSolid*> painted;
  for (const SceneSolid& solid : scene.solids) {
    if (solid.level) painted.push_back(&solid);
  }
  std::stable_sort(painted.begin(), painted.end(), [](const SceneSolid* a, const SceneSolid* b) {
    return a->ball.centre.norm() > b->ball.centre.norm();
  });
  for (const SceneSolid* solid : painted) {
    const Outline outline = outline_of_solid(lens, *solid);
    if (outline.size() >= 3) paint(light, outline, *solid->level, blur_px);
  }
}

}  // namespace asterism
