// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

using Upper = std::array<float, 6>;  // xx xy xz yy yz zz of a symmetric matrix

[[nodiscard]] inline float along(const Upper& m, const Vec3f& n) {
  return m[0] * n.x() * n.x() + m[3] * n.y() * n.y() + m[5] * n.z() * n.z() +
         2 * (m[1] * n.x() * n.y() + m[2] * n.x() * n.z() + m[4] * n.y() * n.z());
}
inline void add_to(Upper& sum, float factor, const Upper& m) {
  for (std::size_t i = 0; i < 6; ++i) sum[i] += factor * m[i];
}

/// What one part of a scan, or several settled ones, say of a place: float, about the voxel's centre.
struct VoxelPart {
  Vec3f at = Vec3f::Zero();               // mm from the voxel's centre
  Upper noise{}, systematic{};            // mm²
  Vec3f normals = Vec3f::Zero();          // their sum, one a point
  float range_mm = 0, cos_incidence = 0;  // sums
  std::uint32_t points = 0;
  std::int32_t scan = 0;          // the one that gave most of it,
  std::uint32_t scan_points = 0;  // so many
  std::int32_t last_scan = 0;
  std::uint16_t scans = 0;
};

/// What is left of parts that agree, and what was refused.
struct AgreedParts {
  VoxelPart all;                 // their mean, sums of the rest
  Vec3f normal = Vec3f::Zero();  // unit; zero when none is known
  std::uint32_t refused = 0;     // points
  bool shared = false;           // there was more than one part
  float chi2 = 0;                // then: of the first part against all others, before any was refused
  float apart_mm2 = 0;           // that part's distance from the others, squared, as one scan's share of it
  float stated_mm2 = 0;          // and what its covariance says of it
};
/// At least one part, in the order in which they came. `largest_chi2` is for one degree of freedom. What is
/// refused is taken out of `parts`, the worst first.
[[nodiscard]] AgreedParts agreement_of(std::vector<VoxelPart>& parts, float largest_chi2);

}  // namespace asterism
