// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/cell/cell.hpp"

namespace asterism {

/// How well the centre of a disc's image can be known from its grey levels. The edge carries it all: a disc
/// of radius ρ, blurred by a Gaussian of σ_b, of height A in a noise of σ_n a pixel has
///
///   ∫ (∂I/∂x)² = √π ρ A² / (2 σ_b),   σ² = σ_n² / that:
///
/// the Cramér–Rao bound with all else known. Of an ellipse ρ is the shorter semi-axis. Levels are shares of
/// full scale.
struct CentreBound {
  double blur_px = 0.62;
  double amplitude = 0.75;          // of a target seen square on
  double retro_falloff_rad = 0.91;  // amplitude · exp(−(incidence / falloff)⁴); 0 = does not fall off
  double shot = 0;                  // variance of the noise a unit of level
  double background_variance = 0;   // of a pixel without the target's light

  /// Variance (px²) times ρ (px).
  [[nodiscard]] double variance_times_px(double incidence_rad) const;
};
[[nodiscard]] CentreBound centre_bound(const Sensor& sensor, const Light& light);

}  // namespace asterism
