// SPDX-License-Identifier: Apache-2.0
#include "asterism/camera/lens.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

Lens lens_with(int coefficients) {
  Lens lens{1200, 1190, 0.7, 640.5, 481.25, {}, coefficients, 1280, 960};
  const std::array<double, 14> values = {-0.21,  0.09,   0.0011,  -0.0007, -0.013, 0.05,  0.01,
                                         -0.002, 0.0009, -0.0004, 0.0006,  0.0003, 0.012, -0.009};
  for (int i = 0; i < coefficients; ++i)
    lens.distortion[static_cast<std::size_t>(i)] = values[static_cast<std::size_t>(i)];
  return lens;
}

class LensModels : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Coefficients, LensModels, testing::Values(0, 4, 5, 8, 12, 14));

TEST_P(LensModels, SightLineUndoesProjectionToAMillionthOfAPixel) {
  const Lens lens = lens_with(GetParam());
  RandomStream random(1, 0);
  for (int i = 0; i < 500; ++i) {
    const Vec3 point(random.uniform(-900, 900), random.uniform(-700, 700), random.uniform(1800, 2500));
    const auto image = project(lens, point);
    ASSERT_TRUE(image);
    const auto ray = sight_line(lens, image->px);
    ASSERT_TRUE(ray);
    EXPECT_LT((ray->xy - point.hnormalized()).norm() * lens.fx, 1e-6);
  }
}

TEST_P(LensModels, JacobiansEqualCentralDifferences) {
  const Lens lens = lens_with(GetParam());
  const Vec3 point(310, -220, 1500);
  const auto at = project(lens, point);
  ASSERT_TRUE(at);
  constexpr double kStep = 1e-4;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = kStep * Vec3::Unit(axis);
    const Vec2 slope = (project(lens, point + step)->px - project(lens, point - step)->px) / (2 * kStep);
    EXPECT_LT((slope - at->by_point.col(axis)).norm(), 1e-6) << "axis " << axis;
  }
  const auto ray = sight_line(lens, at->px);
  for (int axis = 0; axis < 2; ++axis) {
    const Vec2 step = 1e-3 * Vec2::Unit(axis);
    const Vec2 slope = (sight_line(lens, at->px + step)->xy - sight_line(lens, at->px - step)->xy) / 2e-3;
    EXPECT_LT((slope - ray->by_px.col(axis)).norm() * lens.fx, 1e-6) << "axis " << axis;
  }
}

TEST_P(LensModels, ParameterJacobianEqualsCentralDifferences) {
  const Lens lens = lens_with(GetParam());
  const Vec2 xy(0.21, -0.17);
  const auto by = pixel_by_parameters(lens, xy);
  ASSERT_EQ(by.cols(), 5 + GetParam());
  const auto moved = [&](int parameter, double step) {
    Lens other = lens;
    double* first[] = {&other.fx, &other.fy, &other.skew, &other.cx, &other.cy};
    (parameter < 5 ? *first[parameter] : other.distortion[static_cast<std::size_t>(parameter - 5)]) += step;
    return pixel_from_normalised(other, distort(other, xy).xy);
  };
  for (int parameter = 0; parameter < by.cols(); ++parameter) {
    const Vec2 slope = (moved(parameter, 1e-5) - moved(parameter, -1e-5)) / 2e-5;
    EXPECT_LT((slope - by.col(parameter)).norm(), 1e-4) << "parameter " << parameter;
  }
}

TEST(Project, RefusesWhatLiesBehindTheCamera) {
  EXPECT_EQ(project(lens_with(0), Vec3(0, 0, -1)).error(), LensFailure::BehindCamera);
}

TEST(SightLine, SaysSoWhereThePolynomialFoldsBack) {
  Lens lens = lens_with(0);
  lens.coefficients = 4;
  lens.distortion[0] = -0.5;  // r(1 − r²/2) never exceeds 0.544
  EXPECT_EQ(sight_line(lens, Vec2(lens.cx + 0.6 * lens.fx, lens.cy)).error(), LensFailure::NoConvergence);
}

}  // namespace
}  // namespace asterism
