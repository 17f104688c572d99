// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/geometry/types.hpp"

namespace asterism {

/// What the RMS of pairs of points depends on, as they are added and taken away.
struct FitMoments {
  double count = 0;
  Vec3 sum_a = Vec3::Zero(), sum_b = Vec3::Zero();
  Mat3 cross = Mat3::Zero();
  double squares = 0;

  void add(const Vec3& a, const Vec3& b) {
    count += 1;
    sum_a += a;
    sum_b += b;
    cross += a * b.transpose();
    squares += a.squaredNorm() + b.squaredNorm();
  }
};

/// No more than the sum of the squared residuals of the best proper rigid fit, and hardly less: the largest
/// root of λ⁴ − 2|S|²λ² − 8 det(S) λ + |S|⁴ − 4|cof S|², by Newton's method from above (Horn 1987,
/// Theobald 2005). Near a double root, as of flat layouts, it is known to the square root of rounding.
[[nodiscard]] double least_squares_sum(const FitMoments& moments);

}  // namespace asterism
