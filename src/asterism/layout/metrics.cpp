// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/geometry/point_sets.hpp"

namespace asterism {
namespace {

/// Points that lie on the sphere sought: at most four.
struct Boundary {
  std::array<Vec3, 4> point;
  std::size_t count = 0;
};

/// Centre of the smallest sphere through the points of the boundary, from the first of them.
Vec3 from_first_to_centre(const Boundary& boundary) {
  const Vec3 a = boundary.count > 1 ? Vec3(boundary.point[1] - boundary.point[0]) : Vec3(Vec3::Zero());
  if (boundary.count <= 2) return 0.5 * a;
  const Vec3 b = boundary.point[2] - boundary.point[0];
  if (boundary.count == 3) {
    const Vec3 n = a.cross(b);
    return (a.squaredNorm() * b.cross(n) + b.squaredNorm() * n.cross(a)) / (2 * n.squaredNorm());
  }
  const Vec3 c = boundary.point[3] - boundary.point[0];
  return (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
         (2 * a.dot(b.cross(c)));
}

Sphere through(const Boundary& boundary) {
  if (boundary.count == 0) return {Vec3::Zero(), -1};
  const Vec3 to_centre = from_first_to_centre(boundary);
  return {boundary.point[0] + to_centre, to_centre.norm()};
}

bool holds(const Sphere& sphere, const Vec3& point) {
  constexpr double kRounding = 1e-12;  // relative; a point on the sphere counts as held
  return sphere.radius_mm >= 0 &&
         (point - sphere.centre_mm).norm() <= sphere.radius_mm * (1 + kRounding) + kRounding;
}

/// The smallest sphere that holds the points and has the boundary's points on it.
Sphere enclose(std::span<const Vec3> points, const Boundary& boundary) {
  Sphere sphere = through(boundary);
  if (boundary.count == 4) return sphere;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (holds(sphere, points[i])) continue;
    Boundary with = boundary;
    with.point[with.count++] = points[i];
    const Sphere grown = enclose(points.first(i), with);
    if (!grown.centre_mm.allFinite()) continue;  // on the sphere's surface but for rounding
    sphere = grown;
  }
  return sphere;
}

void measure_distances(std::span<const Vec3> targets, LayoutMetrics& metrics) {
  const auto n = static_cast<double>(targets.size());
  for (const Vec3& target : targets) {
    const double radius = (target - metrics.centroid_mm).norm();
    metrics.max_radius_mm = std::max(metrics.max_radius_mm, radius);
    metrics.mean_distance_to_centroid_mm += radius / n;
    metrics.mean_distance_to_origin_mm += target.norm() / n;
  }
  double squares = 0;
  for (const Vec3& target : targets) {
    const double off = (target - metrics.centroid_mm).norm() - metrics.mean_distance_to_centroid_mm;
    squares += off * off;
  }
  metrics.symmetry_mm = std::sqrt(squares / (n - 1));

  metrics.min_pair_distance_mm = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (std::size_t j = i + 1; j < targets.size(); ++j) {
      const double distance = (targets[i] - targets[j]).norm();
      metrics.pair_distance_sum_mm += distance;
      metrics.min_pair_distance_mm = std::min(metrics.min_pair_distance_mm, distance);
    }
  }
  metrics.mean_pair_distance_mm = metrics.pair_distance_sum_mm / (0.5 * n * (n - 1));
}

void measure_shape(std::span<const Vec3> targets, LayoutMetrics& metrics) {
  Mat3 scatter = Mat3::Zero();
  for (const Vec3& target : targets) {
    const Vec3 off = target - metrics.centroid_mm;
    scatter += off * off.transpose();
  }
  const SymmetricEigen3 axes = symmetric_eigen(scatter);
  const Vec3 variance = axes.values.reverse().cwiseMax(0.0) / static_cast<double>(targets.size());
  metrics.principal_rms_mm = variance.cwiseSqrt();
  const Vec3 normal = axes.vectors.col(0);
  double squares = 0;  // summed anew: the root of a rounded eigenvalue would be off by 1e-5 mm
  for (const Vec3& target : targets) {
    const double off = normal.dot(target - metrics.centroid_mm);
    squares += off * off;
    metrics.off_plane_mm = std::max(metrics.off_plane_mm, std::abs(off));
  }
  metrics.thickness_mm = std::sqrt(squares / static_cast<double>(targets.size()));
  metrics.principal_rms_mm(2) = metrics.thickness_mm;
}

}  // namespace

Sphere minimum_enclosing_sphere(std::span<const Vec3> points) {
  require(!points.empty(), "an enclosing sphere holds at least one point");
  return enclose(points, {});
}

LayoutMetrics measure_layout(std::span<const Vec3> targets) {
  require(targets.size() >= 2, "a layout has two targets or more");
  LayoutMetrics metrics;
  metrics.targets = static_cast<int>(targets.size());
  metrics.centroid_mm = centroid_of(targets);
  measure_distances(targets, metrics);
  measure_shape(targets, metrics);
  metrics.enclosing_sphere = minimum_enclosing_sphere(targets);
  return metrics;
}

}  // namespace asterism
