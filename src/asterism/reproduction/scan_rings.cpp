// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/scan_rings.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {
namespace {

constexpr double kSameRingMm = 20;  // rings lie hundreds apart
constexpr double kSearchDeg = 20;   // beyond the platform's stroke

using Rings = std::vector<std::vector<Vec3>>;

/// The stations turned back by `tilt`, split into rings where z leaves a gap.
Rings rings_at(std::span<const Vec3> stations, double tilt_deg) {
  const Quaternion back = exp_rotation({0, -rad_from_deg(tilt_deg), 0});
  std::vector<Vec3> flat;
  for (const Vec3& station : stations) flat.push_back(back * station);
  std::sort(flat.begin(), flat.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  Rings rings;
  for (const Vec3& station : flat) {
    if (rings.empty() || station.z() - rings.back().back().z() > kSameRingMm) rings.emplace_back();
    rings.back().push_back(station);
  }
  return rings;
}

double spread_in_z(const Rings& rings) {
  double squares = 0;
  for (const auto& points : rings) {
    double mean = 0;
    for (const Vec3& point : points) mean += point.z() / static_cast<double>(points.size());
    for (const Vec3& point : points) squares += (point.z() - mean) * (point.z() - mean);
  }
  return squares;
}

/// Sum of squares about the planes of the rings, with a price for each ring more: without it every point
/// would be a ring of its own.
double cost_of_tilt(std::span<const Vec3> stations, double tilt_deg) {
  const Rings rings = rings_at(stations, tilt_deg);
  return spread_in_z(rings) + kSameRingMm * kSameRingMm * static_cast<double>(rings.size());
}

double best_tilt_deg(std::span<const Vec3> stations) {
  double best = 0, width = kSearchDeg;
  while (width > 1e-5) {
    const double centre = best;
    for (int i = -20; i <= 20; ++i) {
      const double tilt = centre + width * i / 20;
      if (cost_of_tilt(stations, tilt) < cost_of_tilt(stations, best)) best = tilt;
    }
    width /= 10;
  }
  return best;
}

/// The smallest gap between azimuths.
double step_of(const Rings& rings) {
  double step = 360;
  for (const auto& points : rings) {
    std::vector<double> azimuths;
    for (const Vec3& point : points) azimuths.push_back(deg_from_rad(std::atan2(point.y(), point.x())));
    std::sort(azimuths.begin(), azimuths.end());
    for (std::size_t i = 1; i < azimuths.size(); ++i) step = std::min(step, azimuths[i] - azimuths[i - 1]);
  }
  return std::round(step);
}

/// Least squares through the rings' (z, radius).
void fit_cone(ScanRings& found) {
  double z = 0, r = 0;
  const auto n = static_cast<double>(found.rings.size());
  for (const ScanRing& ring : found.rings) {
    z += ring.z_mm / n;
    r += ring.radius_mm / n;
  }
  double zz = 0, zr = 0;
  for (const ScanRing& ring : found.rings) {
    zz += (ring.z_mm - z) * (ring.z_mm - z);
    zr += (ring.z_mm - z) * (ring.radius_mm - r);
  }
  found.slope = zz > 0 ? zr / zz : 0;
  found.radius_at_zero_mm = r - found.slope * z;
}

}  // namespace

ScanRings fit_rings(std::span<const Vec3> stations) {
  require(!stations.empty(), "rings are fitted to stations");
  ScanRings found;
  found.points = stations.size();
  found.tilt_deg = best_tilt_deg(stations);
  const auto rings = rings_at(stations, found.tilt_deg);
  found.step_deg = step_of(rings);
  std::size_t fullest = 0;
  for (const auto& points : rings) {
    ScanRing ring;
    ring.points = points.size();
    fullest = std::max(fullest, ring.points);
    for (const Vec3& point : points) {
      ring.z_mm += point.z() / static_cast<double>(ring.points);
      ring.radius_mm += point.head<2>().norm() / static_cast<double>(ring.points);
    }
    for (const Vec3& point : points) {
      found.residual_mm = std::max({found.residual_mm, std::abs(point.head<2>().norm() - ring.radius_mm),
                                    std::abs(point.z() - ring.z_mm)});
    }
    found.rings.push_back(ring);
  }
  found.pattern_points = fullest * rings.size();
  fit_cone(found);
  return found;
}

}  // namespace asterism
