// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/voxel_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asterism {
namespace {

constexpr float kLeastVariance = 1e-12F;  // mm²; so that what is stated as exact still has a weight

/// How far the parts' mean normal may be off: its points' spread, and a degree in any case.
struct Facing {
  Vec3f normal = Vec3f::Zero();
  float tilt2 = 0;  // rad²
};

Facing facing_of(const std::vector<VoxelPart>& parts) {
  Vec3f sum = Vec3f::Zero();
  float points = 0;
  for (const VoxelPart& part : parts) {
    sum += part.normals;
    points += static_cast<float>(part.points);
  }
  Facing facing;
  const float length = sum.norm();
  if (length < 1e-6F * points) return facing;
  facing.normal = sum / length;
  constexpr float kDegree2 = 3e-4F;
  facing.tilt2 = kDegree2 + std::max(0.F, 1 - length / points) / points;
  return facing;
}

float variance_of(const Upper& m, const Vec3f& normal) {
  const float variance = normal.isZero() ? (m[0] + m[3] + m[5]) / 3 : along(m, normal);
  return std::max(variance, kLeastVariance);
}

/// Weighed by what each is worth along the normal.
struct Mean {
  Vec3f at;
  float weight;
};
Mean mean_of(const std::vector<VoxelPart>& parts, const Vec3f& normal, std::size_t without) {
  Mean mean{Vec3f::Zero(), 0};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i == without) continue;
    const float weight = 1 / variance_of(parts[i].noise, normal);
    mean.at += weight * parts[i].at;
    mean.weight += weight;
  }
  mean.at /= mean.weight;
  return mean;
}

/// A part against the others: along the normal, with room for the normal's own error over the distance
/// between them.
struct Contrast {
  float off2, variance;
  [[nodiscard]] float chi2() const { return off2 / variance; }
};
Contrast contrast_of(const std::vector<VoxelPart>& parts, std::size_t which, const Facing& facing) {
  const Mean others = mean_of(parts, facing.normal, which);
  const Vec3f apart = parts[which].at - others.at;
  const float variance = variance_of(parts[which].noise, facing.normal) + 1 / others.weight;
  if (facing.normal.isZero()) return {apart.squaredNorm() / 3, variance};
  const float off = apart.dot(facing.normal);
  const float beside2 = std::max(0.F, apart.squaredNorm() - off * off);
  return {off * off, variance + facing.tilt2 * beside2};
}

VoxelPart joined(const std::vector<VoxelPart>& parts, const Vec3f& normal) {
  if (parts.size() == 1) return parts.front();
  VoxelPart all;
  const Mean mean = mean_of(parts, normal, parts.size());
  all.at = mean.at;
  all.last_scan = std::numeric_limits<std::int32_t>::min();
  for (const VoxelPart& part : parts) {
    const float share = 1 / variance_of(part.noise, normal) / mean.weight;
    add_to(all.noise, share * share, part.noise);
    add_to(all.systematic, share, part.systematic);
    all.normals += part.normals;
    all.range_mm += part.range_mm;
    all.cos_incidence += part.cos_incidence;
    all.points += part.points;
    const bool again = all.scans > 0 && part.scans == 1 && part.scan == all.last_scan;
    all.scans = static_cast<std::uint16_t>(std::min(65535, all.scans + part.scans - (again ? 1 : 0)));
    all.last_scan = part.last_scan;
    if (part.scan == all.scan && all.scan_points > 0) {
      all.scan_points += part.scan_points;
    } else if (part.scan_points > all.scan_points) {
      all.scan = part.scan;
      all.scan_points = part.scan_points;
    }
  }
  return all;
}

/// Of two that only contradict each other, χ² cannot tell which one is wrong: the one of fewer points is
/// taken for it, then the noisier one, then the later one.
std::size_t weaker_of_two(const std::vector<VoxelPart>& parts, const Vec3f& normal) {
  if (parts[0].points != parts[1].points) return parts[0].points < parts[1].points ? 0 : 1;
  return variance_of(parts[0].noise, normal) > variance_of(parts[1].noise, normal) ? 0 : 1;
}

}  // namespace

AgreedParts agreement_of(std::vector<VoxelPart>& parts, float largest_chi2) {
  AgreedParts agreed;
  Facing facing = facing_of(parts);
  agreed.shared = parts.size() > 1;
  if (agreed.shared) {
    const Contrast first = contrast_of(parts, 0, facing);
    const float share = 1 - 1 / static_cast<float>(parts.size());  // of 1 + 1/(n − 1), what one part adds
    agreed.chi2 = first.chi2();
    agreed.apart_mm2 = share * first.off2;
    agreed.stated_mm2 = share * first.variance;
  }
  while (parts.size() > 1) {
    std::size_t worst = 0;
    float worst_chi2 = -1;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const float chi2 = contrast_of(parts, i, facing).chi2();
      if (chi2 <= worst_chi2) continue;
      worst = i;
      worst_chi2 = chi2;
    }
    if (worst_chi2 <= largest_chi2) break;
    if (parts.size() == 2) worst = weaker_of_two(parts, facing.normal);
    agreed.refused += parts[worst].points;
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(worst));
    facing = facing_of(parts);
  }
  agreed.normal = facing.normal;
  agreed.all = joined(parts, facing.normal);
  return agreed;
}

}  // namespace asterism
