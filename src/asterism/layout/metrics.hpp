// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "asterism/geometry/types.hpp"

namespace asterism {

struct Sphere {
  Vec3 centre_mm = Vec3::Zero();
  double radius_mm = 0;
};

/// The smallest sphere that holds all points (one or more). Exact but for rounding: Welzl 1991.
[[nodiscard]] Sphere minimum_enclosing_sphere(std::span<const Vec3> points);

/// What can be said of a layout by its coordinates alone. Distances in mm; all but the distance to the
/// origin stay the same when the layout is moved as a whole. C is the centroid.
struct LayoutMetrics {
  int targets = 0;
  Vec3 centroid_mm = Vec3::Zero();
  double max_radius_mm = 0;                 // farthest target from C (the paper's Table 2)
  double symmetry_mm = 0;                   // standard deviation (n − 1) of the distances to C (Table 2)
  double mean_distance_to_centroid_mm = 0;  // what the paper's Section 3.3 computes as Cost
  double mean_distance_to_origin_mm = 0;    // f1 of its Section 4.2
  double pair_distance_sum_mm = 0;          // over pairs i < j: Coverage, −f2 of its Section 4.2
  double mean_pair_distance_mm = 0;         // Eq. 24; Eq. 27 is half of it
  double min_pair_distance_mm = 0;          // what Eq. 28 holds above d_min
  Sphere enclosing_sphere;
  Vec3 principal_rms_mm = Vec3::Zero();  // RMS distance from C along the principal axes, largest first
  double thickness_mm = 0;               // its smallest: RMS distance from the plane of best fit, σ₃/√n
  double off_plane_mm = 0;               // farthest target from that plane; 0 = coplanar
};

/// Throws ContractViolation for fewer than two targets.
[[nodiscard]] LayoutMetrics measure_layout(std::span<const Vec3> targets);

}  // namespace asterism
