// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "asterism/core/result.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

enum class RigidFitFailure { TooFewPoints, Collinear };

struct RigidFit {
  RigidMotion a_from_b;
  double rms = 0;  // mm, of |in_a − a_from_b · in_b|
};

/// The rigid motion that minimises Σ wᵢ |aᵢ − (R bᵢ + t)|² with det R = +1 (paper Eq. 18, where the sign
/// of the determinant is left open; Kabsch 1976, Umeyama 1991). `weights` may be empty (all one).
/// Needs three points that do not lie on a line.
[[nodiscard]] Result<RigidFit, RigidFitFailure> fit_rigid_motion(std::span<const Vec3> in_a,
                                                                 std::span<const Vec3> in_b,
                                                                 std::span<const double> weights = {});

/// The frame of three points: x along p2 − p1, z along (p2 − p1) × (p3 − p1), y = z × x, origin p1
/// (paper Section 2.3, re-orthogonalised; the matrix printed as Eqs. 11–13 is not a rotation).
[[nodiscard]] Result<RigidMotion, RigidFitFailure> frame_from_three_points(const Vec3& p1, const Vec3& p2,
                                                                           const Vec3& p3);

/// The motion between two sets of points by their three-point frames alone (the paper's way; each
/// later point is ignored). Kept for comparison: it is about twice as noisy as the fit above.
[[nodiscard]] Result<RigidFit, RigidFitFailure> three_point_motion(std::span<const Vec3> in_a,
                                                                   std::span<const Vec3> in_b);

}  // namespace asterism
