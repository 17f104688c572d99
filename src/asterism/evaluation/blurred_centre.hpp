// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/accuracy/centre_sigma.hpp"
#include "asterism/geometry/types.hpp"

namespace asterism {

/// How well the centre of a round target's image can be known that moves while it is exposed. The streak of
/// length L widens the disc's profile along the way it goes, and beyond the disc's diameter dims it:
///
///   I(k) = A · 2πρ J₁(kρ)/k · sinc(k·u L/2) · exp(−σ_b² k²/2),   information = ∫ k kᵀ |I|² d²k / (2π)² /
///   σ_n²
///
/// with u the streak's direction: the Cramér–Rao bound with all else known, noise alike all over.
class BlurredCentreBound {
 public:
  /// For discs about this large: the blur and a target's level are the sensor's.
  BlurredCentreBound(const CentreBound& at_rest, double radius_px, double longest_streak_px);

  /// By how much the deviation grows along and across a streak; 1 for none.
  struct Growth {
    double along = 1, across = 1;
  };
  [[nodiscard]] Growth growth(double streak_px) const;

  /// A covariance (px²) at rest grown by a streak (px, its direction and length).
  [[nodiscard]] Mat2 grown(const Mat2& at_rest, const Vec2& streak_px) const;

 private:
  double step_px_;
  std::vector<Growth> growth_;  // by streak, `step_px_` apart
};

}  // namespace asterism
