// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/blurred_centre.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace asterism {
namespace {

constexpr double kRadius_px = 6;

CentreBound at_rest() {
  CentreBound bound;
  bound.blur_px = 0.8;
  return bound;
}

/// A disc with a blurred edge, smeared along x by `streak`: the mean of many discs on the way.
double level(double x, double y, double streak) {
  constexpr int kOnTheWay = 32;
  double sum = 0;
  for (int i = 0; i < kOnTheWay; ++i) {
    const double along = streak * ((i + 0.5) / kOnTheWay - 0.5);
    const double beyond = std::hypot(x - along, y) - kRadius_px;
    sum += 0.5 * std::erfc(beyond / (std::sqrt(2.0) * at_rest().blur_px));
  }
  return sum / kOnTheWay;
}

/// ∫ (∂I/∂x)² and ∫ (∂I/∂y)² on a raster.
Vec2 information(double streak) {
  constexpr double kStep = 0.5;
  Vec2 sum = Vec2::Zero();
  for (double x = -18; x < 18; x += kStep) {
    for (double y = -10; y < 10; y += kStep) {
      const double by_x = (level(x + 0.05, y, streak) - level(x - 0.05, y, streak)) / 0.1;
      const double by_y = (level(x, y + 0.05, streak) - level(x, y - 0.05, streak)) / 0.1;
      sum += kStep * kStep * Vec2(by_x * by_x, by_y * by_y);
    }
  }
  return sum;
}

TEST(BlurredCentreBound, AgreesWithARasteredDisc) {
  const BlurredCentreBound bound(at_rest(), kRadius_px, 20);
  const Vec2 still = information(0);
  for (const double streak : {1.0, 3.0, 8.0, 16.0}) {
    const Vec2 moving = information(streak);
    const auto growth = bound.growth(streak);
    // The raster's disc has its edge blurred across the edge, not in the plane: 2 % at this radius.
    EXPECT_NEAR(growth.along, std::sqrt(still.x() / moving.x()), 0.02 * growth.along) << streak;
    EXPECT_NEAR(growth.across, std::sqrt(still.y() / moving.y()), 0.02 * growth.across) << streak;
  }
}

TEST(BlurredCentreBound, DoesNotChangeWhatStandsStill) {
  const BlurredCentreBound bound(at_rest(), kRadius_px, 20);
  EXPECT_DOUBLE_EQ(bound.growth(0).along, 1);
  EXPECT_DOUBLE_EQ(bound.growth(0).across, 1);
  const Mat2 covariance = (Mat2() << 4e-4, 1e-4, 1e-4, 9e-4).finished();
  EXPECT_EQ(bound.grown(covariance, Vec2::Zero()), covariance);
}

TEST(BlurredCentreBound, GrowsAlongTheStreakWhicheverWayItGoes) {
  const BlurredCentreBound bound(at_rest(), kRadius_px, 20);
  const auto growth = bound.growth(10);
  EXPECT_GT(growth.along, growth.across);
  for (const double angle : {0.0, 0.7, 2.0}) {
    const Vec2 u(std::cos(angle), std::sin(angle));
    const Mat2 grown = bound.grown(1e-4 * Mat2::Identity(), 10 * u);
    EXPECT_NEAR(u.dot(grown * u), 1e-4 * growth.along * growth.along, 1e-12);
    const Vec2 across(-u.y(), u.x());
    EXPECT_NEAR(across.dot(grown * across), 1e-4 * growth.across * growth.across, 1e-12);
  }
}

}  // namespace
}  // namespace asterism
