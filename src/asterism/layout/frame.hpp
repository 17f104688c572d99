// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {

/// The frame of the first three targets: origin at the first, x towards the second, z along
/// (p2 − p1) × (p3 − p1), y = z × x (the paper's Section 2.2, Eqs. 11 and 12, made orthogonal).
/// Lengths in mm; later targets are not looked at.
[[nodiscard]] Result<RigidMotion, RigidFitFailure> three_point_frame(std::span<const Vec3> targets);

/// Which vectors the axes of a centroid frame come from. Of the first two targets' two recipes in the
/// paper one points z up and the other down: for Table 1 the frames lie 179° apart.
enum class CentroidAxes {
  BetweenTargets,  // Section 2.3: x along p2 − p1, z along (p2 − p1) × (p3 − p1)
  FromCentroid     // Eqs. 15 and 16: x along p2 − C, z along (p2 − C) × (p1 − C)
};

/// The frame whose origin is the centroid C of all targets (Eq. 14), y = z × x. Returns body_from_local.
[[nodiscard]] Result<RigidMotion, RigidFitFailure> centroid_frame(
    std::span<const Vec3> targets, CentroidAxes axes = CentroidAxes::BetweenTargets);

/// Where the targets are in a frame: inverse(body_from_local) · p. The paper's Eq. 17 prints R (p − C),
/// but an R whose columns are the axes has to be transposed.
[[nodiscard]] std::vector<Vec3> local_coordinates(const RigidMotion& body_from_local,
                                                  std::span<const Vec3> targets);

/// The matrix [v1/|v1|  v2/|v2|  n/|n|] as the paper prints it (Eq. 13), v1 = p2 − p1, v2 = p3 − p1. It is
/// **no rotation**, since v1 and v2 are not at right angles: for Table 1 its determinant is 0.769, 0.764
/// and 0.447. Kept as a counter-example; nothing here uses it.
[[nodiscard]] Mat3 axes_as_printed(std::span<const Vec3> targets);

}  // namespace asterism
