// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/geometry/congruence.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {

/// The most likely place of a body under given labels.
struct LabelFit {
  RigidMotion tracker_from_body;
  Mat6 information;       // inverse covariance of that motion, ω (rad), δ (mm)
  double chi_square = 0;  // of the 3k coordinates; 3k − 6 degrees of freedom
  double rms_mm = 0;
  double log_det_covariances = 0;  // Σ ln |Σᵢ|, mm²
};

/// Maximises Π N(pᵢ; R qᵢ + t, Σᵢ + R Cᵢ Rᵀ) over proper rotations: Kabsch for a start, then Gauss–Newton
/// with each point's whole covariance, since a stereo rig knows depth several times worse than the rest.
[[nodiscard]] Result<LabelFit, RigidFitFailure> fit_labels(std::span<const Correspondence> labels,
                                                           std::span<const UncertainPoint> targets,
                                                           std::span<const UncertainPoint> scene);

/// Value that χ² with `degrees` exceeds as rarely as a normal variable exceeds `sigma` standard deviations
/// (Wilson & Hilferty 1931).
[[nodiscard]] double chi_square_limit(double sigma, double degrees);

/// What an accidental fit is weighed against.
struct Clutter {
  double points;           // in the frame
  double density_per_mm3;  // where the body is
};

/// ln of the number of ways in which points at random, as dense as these, are expected to fit `labels` of
/// `targets` targets at least as well as this fit does (the number of false alarms of Desolneux, Moisan
/// & Morel): the volume of the tube √(χ²) wide around all poses, in the space of the points' coordinates,
///   C(n, k) N ρᵏ⁻¹ · 8π² |I|^½ Π|Σᵢ|^½ V₃ₖ₋₆(√χ²).
[[nodiscard]] double log_accidental_fits(const LabelFit& fit, std::size_t labels, std::size_t targets,
                                         const Clutter& clutter);

/// The same when only poses in a region of `log_pose_volume` (ln of rad³ mm³) are allowed.
[[nodiscard]] double log_accidental_fits_within(double log_pose_volume, const LabelFit& fit,
                                                std::size_t labels, std::size_t targets,
                                                const Clutter& clutter);

/// ln of the volume of a ball.
[[nodiscard]] double log_ball_volume(double dimensions, double radius);

}  // namespace asterism
