// SPDX-License-Identifier: Apache-2.0
#include "asterism/camera/lens_lanes.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

Lens lens_with(int coefficients) {
  Lens lens;
  lens.fx = 3200, lens.fy = 3190, lens.skew = 0.7, lens.cx = 1020, lens.cy = 770;
  lens.distortion = {-0.12, 0.08, 3e-4,  -2e-4, -0.02, 0.01, 0.02,
                     0.003, 1e-4, -2e-4, 2e-4,  1e-4,  0.01, -0.02};
  for (std::size_t i = static_cast<std::size_t>(coefficients); i < 14; ++i) lens.distortion[i] = 0;
  lens.coefficients = coefficients;
  lens.width_px = 2048, lens.height_px = 1536;
  return lens;
}

TEST(PixelsOf, AgreesWithTheLensModelOnePointAtATime) {
  for (const int coefficients : {0, 4, 5, 8, 12, 14}) {
    const Lens lens = lens_with(coefficients);
    const LensForLanes lanes(lens);
    const DoubleLanes x = {0.0, 0.21, -0.3, 0.05}, y = {0.0, -0.12, 0.2, 0.22};
    const PixelLanes px = pixels_of(lanes, x, y);
    for (std::size_t lane = 0; lane < kDoubleLanes; ++lane) {
      const Vec2 xy(x[lane], y[lane]);
      const DistortionResult one = distort(lens, xy);
      const Vec2 expected = pixel_from_normalised(lens, one.xy);
      const Mat2 by = pixel_by_normalised(lens) * one.by_xy;
      EXPECT_NEAR(px.u[lane], expected.x(), 1e-9) << coefficients;
      EXPECT_NEAR(px.v[lane], expected.y(), 1e-9) << coefficients;
      EXPECT_NEAR(px.ux[lane], by(0, 0), 1e-8);
      EXPECT_NEAR(px.uy[lane], by(0, 1), 1e-8);
      EXPECT_NEAR(px.vx[lane], by(1, 0), 1e-8);
      EXPECT_NEAR(px.vy[lane], by(1, 1), 1e-8);
      EXPECT_NEAR(px.unfolded[lane], one.by_xy.determinant(), 1e-12);
    }
  }
}

TEST(PixelsOf, TellsWhereTheDistortionFoldsBack) {
  Lens lens = lens_with(4);
  lens.distortion = {-0.5};
  const LensForLanes lanes(lens);
  const DoubleLanes x = {0.1, 0.5, 1.0, 2.0}, y = {0, 0, 0, 0};
  const PixelLanes px = pixels_of(lanes, x, y);
  // r (1 − r² / 2) turns back at r = √(2/3).
  EXPECT_GT(px.unfolded[0], 0);
  EXPECT_GT(px.unfolded[1], 0);
  EXPECT_LT(px.unfolded[2], 0);
}

}  // namespace
}  // namespace asterism
