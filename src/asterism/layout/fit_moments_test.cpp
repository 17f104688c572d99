// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/fit_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asterism/core/random.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

TEST(LeastSquaresSum, IsNeverAboveTheFitsAndHardlyBelow) {
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    RandomStream random(61, trial);
    const double height = trial % 3 == 0 ? 0.0 : trial % 3 == 1 ? 20.0 : 300.0;  // flat, nearly flat, tall
    std::vector<Vec3> a, b;
    FitMoments moments;
    double spread = 0;
    for (std::uint64_t i = 0; i < 4 + trial % 5; ++i) {
      const auto coordinate = [&](double size) { return random.uniform(-size, size); };
      a.emplace_back(coordinate(400), coordinate(400), coordinate(height));
      const double noise = trial % 2 == 0 ? 1.0 : 200.0;
      b.push_back(exp_rotation({0.3, 1.2, -2.0}) * a.back() +
                  Vec3(coordinate(noise), coordinate(noise), coordinate(noise)));
      moments.add(a.back(), b.back());
      spread += a.back().squaredNorm() + b.back().squaredNorm();
    }
    const double sum = std::pow(fit_rigid_motion(a, b)->rms, 2) * static_cast<double>(a.size());
    EXPECT_LE(least_squares_sum(moments), sum + 1e-9) << trial;
    EXPECT_GE(least_squares_sum(moments), sum - 1e-6 * spread) << trial;
  }
}

TEST(LeastSquaresSum, DoesNotFitMirrorImages) {
  FitMoments moments;
  const std::vector<Vec3> points = {{0, 0, 0}, {300, 0, 0}, {0, 200, 0}, {0, 0, 100}};
  std::vector<Vec3> mirrored;
  for (const Vec3& p : points) {
    mirrored.emplace_back(-p.x(), p.y(), p.z());
    moments.add(p, mirrored.back());
  }
  const double rms = fit_rigid_motion(points, mirrored)->rms;
  EXPECT_GT(rms, 20);
  EXPECT_NEAR(least_squares_sum(moments), 4 * rms * rms, 1);
}

}  // namespace
}  // namespace asterism
