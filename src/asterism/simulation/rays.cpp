// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/rays.hpp"

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

/// The part of [0, 1] where from + t · way lies between two parallel planes.
struct Stretch {
  double begin = 0, end = 1;

  void keep_between(double from, double way, double low, double high) {
    if (way == 0) {
      if (from < low || from > high) end = -1;
      return;
    }
    const double t0 = (low - from) / way;
    const double t1 = (high - from) / way;
    begin = std::max(begin, std::min(t0, t1));
    end = std::min(end, std::max(t0, t1));
  }
  [[nodiscard]] bool empty() const { return begin > end; }
};

bool blocks_solid(const Box& box, const Vec3& from, const Vec3& to) {
  Stretch stretch;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * box.size_mm(axis);
    stretch.keep_between(from(axis), to(axis) - from(axis), -half, half);
  }
  return !stretch.empty();
}

bool blocks_solid(const Capsule& capsule, const Vec3& from, const Vec3& to) {
  return segment_distance(from, to, capsule.from_mm, capsule.to_mm) <= capsule.radius_mm;
}

bool blocks_solid(const Frustum& cone, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  Stretch stretch;
  stretch.keep_between(from.z(), way.z(), 0, cone.height_mm);
  if (stretch.empty()) return false;
  // Inside where q(t) = |xy|² − r(z)² ≤ 0, a parabola in t.
  const double slope = (cone.top_radius_mm - cone.bottom_radius_mm) / cone.height_mm;
  const double r0 = cone.bottom_radius_mm + slope * from.z();
  const double rd = slope * way.z();
  const double a = way.head<2>().squaredNorm() - rd * rd;
  const double b = from.head<2>().dot(way.head<2>()) - r0 * rd;
  const double c = from.head<2>().squaredNorm() - r0 * r0;
  const auto inside = [&](double t) { return (a * t + 2 * b) * t + c <= 0; };
  if (inside(stretch.begin) || inside(stretch.end)) return true;
  if (a <= 0) return false;
  const double lowest = -b / a;
  return lowest > stretch.begin && lowest < stretch.end && inside(lowest);
}

Ball ball_of(const Box& box) { return {Vec3::Zero(), 0.5 * box.size_mm.norm()}; }
Ball ball_of(const Capsule& capsule) {
  return {0.5 * (capsule.from_mm + capsule.to_mm),
          0.5 * (capsule.to_mm - capsule.from_mm).norm() + capsule.radius_mm};
}
Ball ball_of(const Frustum& cone) {
  return {{0, 0, 0.5 * cone.height_mm},
          std::hypot(0.5 * cone.height_mm, std::max(cone.bottom_radius_mm, cone.top_radius_mm))};
}

}  // namespace

bool blocks(const Shape& shape, const Vec3& from, const Vec3& to) {
  return std::visit([&](const auto& solid) { return blocks_solid(solid, from, to); }, shape);
}

Ball ball_around(const Shape& shape) {
  return std::visit([](const auto& solid) { return ball_of(solid); }, shape);
}

double segment_distance(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 u = a1 - a0, v = b1 - b0, w = a0 - b0;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const auto unit = [](double t) { return std::clamp(t, 0.0, 1.0); };
  // Nearest on the infinite lines, then held to the segments in turn (Ericson 2005, 5.1.9).
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 1e-12 * uu * vv ? unit((uv * vw - vv * uw) / determinant) : 0.0;
  double t = vv > 0 ? unit((uv * s + vw) / vv) : 0.0;
  if (uu > 0) s = unit((uv * t - uw) / uu);
  return (w + s * u - t * v).norm();
}

}  // namespace asterism
