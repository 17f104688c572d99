// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/viewpoints.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kPurpose = 0x71E75;
constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kGoldenTurn = 2.399963229728653;  // rad

/// Level and along the equator of the line of sight; anything across it where that points up or down.
Vec3 level_beside(const Vec3& ahead) {
  const Vec3 level = Vec3::UnitZ().cross(ahead);
  return level.norm() > 1e-6 ? Vec3(level.normalized()) : Vec3(Vec3::UnitX());
}

/// At the stand-off before the first thing met on the way from one place to another.
void add_view_before(const RayScene& part, const Vec3& from, const Vec3& to, double stand_off_mm,
                     ViewSource source, std::vector<Viewpoint>& views) {
  const auto hit = part.first_hit(from, to);
  if (!hit) return;
  const Vec3 back = (from - to).normalized();
  views.push_back({looking_at(from + hit->share * (to - from), back, stand_off_mm, 0), source});
}

bool is_omitted(double azimuth_deg, std::span<const Sector> omitted) {
  return std::any_of(omitted.begin(), omitted.end(), [&](const Sector& sector) {
    return azimuth_deg > sector.from_deg && azimuth_deg < sector.to_deg;
  });
}

}  // namespace

RigidMotion looking_at(const Vec3& point, const Vec3& towards_scanner, double distance_mm, double roll_rad) {
  Mat3 axes;
  axes.col(2) = -towards_scanner;
  const Vec3 level = level_beside(axes.col(2));
  const Vec3 other = axes.col(2).cross(level);
  axes.col(0) = std::cos(roll_rad) * level + std::sin(roll_rad) * other;
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return {quaternion_from_matrix(axes), point + distance_mm * towards_scanner};
}

std::vector<Viewpoint> views_of_surface(std::span<const SurfaceSample> samples, std::size_t count,
                                        double stand_off_mm, double max_tilt_rad, std::uint64_t seed) {
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].weight > 0) wanted.push_back(i);
  }
  std::vector<Viewpoint> views;
  if (wanted.empty()) return views;
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random(seed, i, kPurpose);
    const double place = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count);
    const auto which = static_cast<std::size_t>(place * static_cast<double>(wanted.size()));
    const SurfaceSample& sample = samples[wanted[std::min(which, wanted.size() - 1)]];
    const double cosine = random.uniform(std::cos(max_tilt_rad), 1.0);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double azimuth = random.uniform(0, kTurn);
    const Vec3 u = sample.normal.unitOrthogonal(), v = sample.normal.cross(u);
    const Vec3 towards = cosine * sample.normal + sine * (std::cos(azimuth) * u + std::sin(azimuth) * v);
    views.push_back({looking_at(sample.at, towards.normalized(), stand_off_mm, random.uniform(0, kTurn)),
                     ViewSource::Surface});
  }
  return views;
}

std::vector<Viewpoint> views_of_sphere(const RayScene& part, const MeshFacts& facts, std::size_t count,
                                       double stand_off_mm) {
  const Vec3 middle = 0.5 * (facts.lowest + facts.highest);
  std::vector<Viewpoint> views;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double r = std::sqrt(1 - z * z), azimuth = kGoldenTurn * static_cast<double>(i);
    const Vec3 out(r * std::cos(azimuth), r * std::sin(azimuth), z);
    add_view_before(part, middle + facts.diagonal_mm() * out, middle, stand_off_mm, ViewSource::Sphere,
                    views);
  }
  return views;
}

std::vector<Viewpoint> views_of_cylinder(const RayScene& part, const MeshFacts& facts, std::size_t count,
                                         double stand_off_mm) {
  const Vec3 middle = 0.5 * (facts.lowest + facts.highest);
  std::vector<Viewpoint> views;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double azimuth = kGoldenTurn * static_cast<double>(i);
    const Vec3 axis(middle.x(), middle.y(),
                    facts.lowest.z() + share * (facts.highest.z() - facts.lowest.z()));
    const Vec3 out = axis + facts.diagonal_mm() * Vec3(std::cos(azimuth), std::sin(azimuth), 0);
    const bool inwards = i % 2 == 0;
    add_view_before(part, inwards ? out : axis, inwards ? axis : out, stand_off_mm, ViewSource::Cylinder,
                    views);
  }
  return views;
}

std::vector<Viewpoint> views_of_rings(const RingPattern& pattern) {
  const double cosine = 1 / std::hypot(1.0, pattern.slope);
  const RigidMotion tilt =
      rotation_about(Vec3::Zero(), rotation_from_yaw_pitch_roll(0, rad_from_deg(pattern.tilt_deg), 0));
  std::vector<Viewpoint> views;
  for (const double z : pattern.heights_mm) {
    for (double azimuth = 0; azimuth < 360 - 1e-9; azimuth += pattern.step_deg) {
      if (is_omitted(azimuth, pattern.omitted)) continue;
      const double a = rad_from_deg(azimuth);
      const Vec3 radial(std::cos(a), std::sin(a), 0);
      const Vec3 station = (pattern.radius_mm + pattern.slope * z) * radial + Vec3(0, 0, z);
      const Vec3 outwards = cosine * (radial - pattern.slope * Vec3::UnitZ());
      views.push_back({tilt * looking_at(station, outwards, 0, 0), ViewSource::Rings});
    }
  }
  return views;
}

RingPattern paper_rings_96() {
  RingPattern pattern{{0, 200, 400}, 751, 0.1208, 9, {}, 0};
  for (const double quadrant : {0, 90, 180, 270}) {
    pattern.omitted.push_back({quadrant + 67.5, quadrant + 85.5});
  }
  return pattern;
}

RingPattern paper_rings_72() { return {{0, 300}, 751, 0.1208, 10, {}, 0}; }

RingPattern rings_around(std::span<const SurfaceSample> samples, double stand_off_mm, double pitch_mm,
                         double step_deg) {
  RingPattern pattern;
  pattern.step_deg = step_deg;
  double low = 0, high = 0, n = 0, z1 = 0, z2 = 0, r1 = 0, rz = 0;
  for (const SurfaceSample& sample : samples) {
    const double r = std::hypot(sample.at.x(), sample.at.y()), z = sample.at.z();
    low = n > 0 ? std::min(low, z) : z;
    high = n > 0 ? std::max(high, z) : z;
    const double outwards = (sample.normal.x() * sample.at.x() + sample.normal.y() * sample.at.y()) / r;
    if (!(outwards > 0.7)) continue;
    n += 1, z1 += z, z2 += z * z, r1 += r, rz += r * z;
  }
  const double spread = n * z2 - z1 * z1;
  pattern.slope = spread > 1e-9 * n * n ? (n * rz - z1 * r1) / spread : 0;
  const double at_zero = n > 0 ? (r1 - pattern.slope * z1) / n : 0;
  pattern.radius_mm = at_zero + stand_off_mm * std::hypot(1.0, pattern.slope);
  const auto rings = std::max(1.0, std::ceil((high - low) / pitch_mm - 1e-6));
  for (double i = 0; i < rings; i += 1) {
    pattern.heights_mm.push_back(low + (i + 0.5) * (high - low) / rings);
  }
  return pattern;
}

}  // namespace asterism
