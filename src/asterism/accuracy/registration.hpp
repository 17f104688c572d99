// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

// A pose from points in space that are all known equally well, σ along each axis: closed forms to screen
// layouts with, where no camera is known.

/// Information of the pose, ω (rad), δ (mm) at the body's origin, along the body's axes:
/// Σ [−[p]× | I]ᵀ [−[p]× | I] / σ².
[[nodiscard]] Mat6 registration_information(std::span<const Vec3> targets, double sigma_mm);

/// √tr of the rotation's covariance, rad. None when the targets lie on one line.
[[nodiscard]] std::optional<double> registration_rotation_error_rad(std::span<const Vec3> targets,
                                                                    double sigma_mm);

/// Target registration error at a point (Fitzpatrick, West & Maurer 1998, to first order exact):
///
///   TRE² = 3σ²/N · (1 + ⅓ Σ_k d_k² / f_k²)
///
/// d_k the point's distance from the targets' k-th principal axis, f_k the targets' RMS distance from it.
/// None when the targets lie on one line.
[[nodiscard]] std::optional<double> registration_error_mm(std::span<const Vec3> targets, const Vec3& point,
                                                          double sigma_mm);

/// The largest error at the point after any one target is lost. None when that leaves it undetermined.
[[nodiscard]] std::optional<double> registration_error_after_loss_mm(std::span<const Vec3> targets,
                                                                     const Vec3& point, double sigma_mm);

}  // namespace asterism
