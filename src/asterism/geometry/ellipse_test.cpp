// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/ellipse.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

TEST(Ellipse, SurvivesTheWayThroughItsShapeMatrix) {
  for (const double angle_deg : {-80.0, -30.0, 0.0, 45.0, 90.0}) {
    const Ellipse start{{12.5, -3}, 9, 5.5, rad_from_deg(angle_deg)};
    const Ellipse end = ellipse_from_shape(start.centre, shape_matrix(start));
    EXPECT_NEAR(end.semi_major, 9, 1e-12);
    EXPECT_NEAR(end.semi_minor, 5.5, 1e-12);
    EXPECT_NEAR(std::abs(std::cos(end.angle_rad - start.angle_rad)), 1, 1e-12) << angle_deg;
  }
}

TEST(EllipseFromDualConic, FindsTheCircleWhateverTheScale) {
  // Lines touching the circle of radius 2 about (3, 4): C* = c cᵀ − r² diag(1, 1, 0), c = (3, 4, 1).
  const Vec3 centre(3, 4, 1);
  const Mat3 dual = -7.0 * (centre * centre.transpose() - 4.0 * Mat3(Vec3(1, 1, 0).asDiagonal()));
  const auto ellipse = ellipse_from_dual_conic(dual);
  ASSERT_TRUE(ellipse);
  EXPECT_LT((ellipse->centre - Vec2(3, 4)).norm(), 1e-12);
  EXPECT_NEAR(ellipse->semi_major, 2, 1e-12);
  EXPECT_NEAR(ellipse->semi_minor, 2, 1e-7);
}

TEST(EllipseFromDualConic, RefusesAHyperbolaAndNonsense) {
  EXPECT_FALSE(ellipse_from_dual_conic(Mat3(Vec3(1, -1, 1).asDiagonal())));
  EXPECT_FALSE(ellipse_from_dual_conic(Mat3::Zero()));
  EXPECT_FALSE(ellipse_from_dual_conic(Mat3::Constant(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace asterism
