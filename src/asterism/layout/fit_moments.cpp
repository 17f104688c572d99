// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/fit_moments.hpp"

#include <cmath>

namespace asterism {

double least_squares_sum(const FitMoments& m) {
  const Mat3 s = m.cross - m.sum_a * m.sum_b.transpose() / m.count;
  const double spread = m.squares - (m.sum_a.squaredNorm() + m.sum_b.squaredNorm()) / m.count;
  const Vec3 minors0 = s.col(1).cross(s.col(2));
  const double norm2 = s.squaredNorm();
  const double minors2 =
      minors0.squaredNorm() + s.col(2).cross(s.col(0)).squaredNorm() + s.col(0).cross(s.col(1)).squaredNorm();
  const double c1 = -8.0 * s.col(0).dot(minors0);
  const double c0 = norm2 * norm2 - 4.0 * minors2;
  double root = 0.5 * spread;
  for (int i = 0; i < 40; ++i) {
    const double square = root * root;
    const double value = square * (square - 2.0 * norm2) + c1 * root + c0;
    const double slope = 4.0 * root * (square - norm2) + c1;
    if (!(slope > 0)) break;
    const double step = value / slope;
    root -= step;
    if (std::abs(step) < 1e-12 * root) break;
  }
  constexpr double kDoubleRoot = 2e-7;
  return spread - 2.0 * root - kDoubleRoot * spread;
}

}  // namespace asterism
