// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/scan_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "asterism/core/parallel.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/geometry/neighbours.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

constexpr std::size_t kBlock = 1024;
constexpr std::size_t kFewest = 5;  // neighbours, for a plane to be told

/// The plane that fits points best: through their mean, the least direction of their spread.
struct Plane {
  Vec3 at, normal;
  double rms_mm;
};

Plane plane_of(std::span<const Vec3> points) {
  Plane plane{Vec3::Zero(), Vec3::UnitZ(), 0};
  for (const Vec3& point : points) plane.at += point;
  plane.at /= static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& point : points) spread += (point - plane.at) * (point - plane.at).transpose();
  const SymmetricEigen3 eigen = symmetric_eigen(spread);
  plane.normal = eigen.vectors.col(0);
  plane.rms_mm = std::sqrt(std::max(0.0, eigen.values[0]) / static_cast<double>(points.size() - 3));
  return plane;
}

double median_of(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What one point's neighbours say of it.
struct Told {
  Vec3f normal = Vec3f::Zero();
  float off_mm = std::numeric_limits<float>::quiet_NaN();  // of their plane, over √(1 + 1/n)
  float next_mm = 0;
  bool outlier = false;
};

Told told_of(const Vec3& point, std::vector<Vec3>& near, const Scanner& scanner, double largest_chi2) {
  Told told;
  if (near.size() < kFewest) {
    told.outlier = true;
    return told;
  }
  told.next_mm = static_cast<float>((near.front() - point).norm());
  // One of the neighbours may be an outlier itself: the worst one does not count.
  const Plane first = plane_of(near);
  const auto off = [&](const Vec3& each) { return std::abs((each - first.at).dot(first.normal)); };
  near.erase(std::max_element(near.begin(), near.end(),
                              [&](const Vec3& a, const Vec3& b) { return off(a) < off(b); }));
  const Plane plane = plane_of(near);
  const Vec3 normal = plane.normal.dot(point) > 0 ? -plane.normal : plane.normal;
  const double away = (point - plane.at).dot(normal);
  const double cosine = std::abs(normal.dot(point)) / point.norm();
  const RangeNoise noise = range_noise(scanner, std::abs(point.z()), cosine);
  const double of_noise = std::pow(noise.depth_mm * normal.z(), 2) +
                          std::pow(noise.lateral_mm, 2) * (1 - normal.z() * normal.z());
  const double spread = std::max(of_noise, plane.rms_mm * plane.rms_mm);
  told.outlier = away * away > 2 * largest_chi2 * spread;
  told.normal = normal.cast<float>();
  told.off_mm = static_cast<float>(away / std::sqrt(1 + 1 / static_cast<double>(near.size())));
  return told;
}

}  // namespace

void describe(ScanSurfaceOptions& options, OptionVisitor& visit) {
  visit.integer("neighbours", options.neighbours, {6, 100}, "that tell a point's normal");
  visit.number("isolated_p", options.isolated_p, {0, 0.5},
               "a point that its neighbours' plane makes less likely than this is refused; 0 = none");
}

ScanSurface surface_of(const Scan& scan, const Scanner& scanner, const ScanSurfaceOptions& options) {
  std::vector<Vec3> points;
  points.reserve(scan.in_scanner.size());
  for (const Vec3f& point : scan.in_scanner) points.emplace_back(point.cast<double>());
  const Neighbours tree(points);
  const double largest_chi2 = options.isolated_p > 0 ? chi_square_quantile(1 - options.isolated_p, 1)
                                                     : std::numeric_limits<double>::infinity();
  ScanSurface surface;
  surface.normals.resize(points.size());
  surface.outlier.resize(points.size());
  std::vector<float> off(points.size()), next(points.size());
  parallel_for((points.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    std::vector<Vec3> near;
    for (std::size_t i = kBlock * block; i < std::min(points.size(), kBlock * (block + 1)); ++i) {
      near.clear();
      for (const std::size_t j :
           tree.few_nearest(points[i], static_cast<std::size_t>(options.neighbours) + 1)) {
        if (j != i) near.push_back(points[j]);
      }
      const Told told = told_of(points[i], near, scanner, largest_chi2);
      surface.normals[i] = told.normal;
      surface.outlier[i] = options.isolated_p > 0 && told.outlier;
      off[i] = std::abs(told.off_mm);
      next[i] = told.next_mm;
    }
  });
  for (const std::uint8_t outlier : surface.outlier) surface.outliers += outlier;
  std::erase_if(off, [](float mm) { return std::isnan(mm); });
  surface.roughness_mm = median_of(off) / normal_quantile(0.75);
  surface.spacing_mm = median_of(next);
  return surface;
}

Scan cleaned(Scan scan, const ScanSurface& surface) {
  const bool own = !scan.normals.empty();
  if (!own) scan.normals = surface.normals;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scan.in_scanner.size(); ++i) {
    if (surface.outlier[i] != 0) continue;
    if (own && scan.normals[i].isZero()) scan.normals[i] = surface.normals[i];
    scan.in_scanner[kept] = scan.in_scanner[i];
    scan.normals[kept] = scan.normals[i];
    if (!scan.times_s.empty()) scan.times_s[kept] = scan.times_s[i];
    ++kept;
  }
  scan.in_scanner.resize(kept);
  scan.normals.resize(kept);
  if (!scan.times_s.empty()) scan.times_s.resize(kept);
  return scan;
}

bool seen_from_origin(const Scan& scan) {
  constexpr double kFew = 0.01;  // share of the points; a few outliers may be anywhere
  std::size_t aside = 0;         // behind, or more than 45° off its axis
  for (const Vec3f& point : scan.in_scanner) aside += point.z() <= point.head<2>().norm() ? 1 : 0;
  return static_cast<double>(aside) <= kFew * static_cast<double>(scan.in_scanner.size());
}

}  // namespace asterism
