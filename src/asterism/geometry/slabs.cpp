// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/slabs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

constexpr double kRoundingMm = 0.01;

/// Calls `visit` for each corner that a triangle uses.
template <class Visit>
void each_corner(const TriangleMesh& surface, const Visit& visit) {
  for (const auto& triangle : surface.triangles) {
    for (const std::uint32_t corner : triangle) visit(surface.vertices[corner]);
  }
}

Mat3 principal_axes(const TriangleMesh& surface) {
  if (surface.empty()) return Mat3::Identity();
  const double count = 3.0 * static_cast<double>(surface.triangles.size());
  Vec3 middle = Vec3::Zero();
  each_corner(surface, [&](const Vec3& corner) { middle += corner; });
  middle /= count;
  Mat3 spread = Mat3::Zero();
  each_corner(surface, [&](const Vec3& c) { spread += (c - middle) * (c - middle).transpose(); });
  return symmetric_eigen(spread).vectors;
}

}  // namespace

Slabs slabs_of(const TriangleMesh& surface) {
  Slabs slabs;
  const Mat3 own = principal_axes(surface);
  for (int k = 0; k < 3; ++k) {
    slabs.axes[static_cast<std::size_t>(k)] = Vec3::Unit(k);
    slabs.axes[static_cast<std::size_t>(k) + 3] = own.col(k);
  }
  slabs.low.fill(std::numeric_limits<double>::infinity());
  slabs.high.fill(-std::numeric_limits<double>::infinity());
  each_corner(surface, [&](const Vec3& corner) {
    for (std::size_t k = 0; k < slabs.axes.size(); ++k) {
      const double at = slabs.axes[k].dot(corner);
      slabs.low[k] = std::min(slabs.low[k], at);
      slabs.high[k] = std::max(slabs.high[k], at);
    }
  });
  return slabs;
}

bool out_of_reach(const Slabs& slabs, const Vec3& disc_centre, const Vec3& disc_normal, double radius_mm,
                  const Vec3& eye) {
  double enters = 0, leaves = 1;
  for (std::size_t k = 0; k < slabs.axes.size(); ++k) {
    const Vec3& axis = slabs.axes[k];
    const double tilt = axis.dot(disc_normal);
    const double half = kRoundingMm + radius_mm * std::sqrt(std::max(0.0, 1 - tilt * tilt));
    const double from = axis.dot(disc_centre), way = axis.dot(eye) - from;
    const double low = slabs.low[k] - half - from, high = slabs.high[k] + half - from;
    if (low > high) return true;
    if (way == 0) {
      if (low > 0 || high < 0) return true;
      continue;
    }
    const double a = low / way, b = high / way;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
    if (enters > leaves) return true;
  }
  return false;
}

}  // namespace asterism
