// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/cell/cell.hpp"

namespace asterism {

/// How well the centre of a disc's image can be known from its grey levels. The edge carries it all: for
/// an image of semi-axes a ≥ b, blurred by a Gaussian of σ_b, of height A in noise σ_n a pixel,
///
///   ∫ (∂I/∂x)² = √π ρ A² / (2 σ_b),   σ² = σ_n² / that,   ρ = b (for both axes: the shorter one's bound)
///
/// the Cramér–Rao bound with all else known. Levels are shares of full scale.
struct CentreBound {
  double blur_px = 0.55;
  double amplitude = 0.75;          // of a target seen square on
  double retro_falloff_rad = 0.91;  // amplitude · exp(−(incidence / falloff)⁴); 0 = does not fall off
  double shot = 0;                  // variance of the noise a unit of level: 1 / full well
  double background_variance = 0;   // at the background's level: shot, read-out and rounding

  /// Variance, px², of a centre whose image has this shorter semi-axis.
  [[nodiscard]] double variance_px2(double semi_minor_px, double incidence_rad) const;
};
[[nodiscard]] CentreBound centre_bound(const Sensor& sensor, const Light& light);

}  // namespace asterism
