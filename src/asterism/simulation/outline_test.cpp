// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "asterism/camera/disc_image.hpp"
#include "asterism/core/random.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {
namespace {

Lens lens_with(int coefficients) {
  Lens lens{3200, 3190, 0.5, 1018.4, 771.3, {}, coefficients, 2048, 1536};
  const double values[] = {-0.21, 0.09, 0.0011, -0.0007, -0.013};
  for (int i = 0; i < coefficients; ++i) lens.distortion[static_cast<std::size_t>(i)] = values[i];
  return lens;
}

DiscPlace random_disc(std::uint64_t index) {
  RandomStream random(11, index);
  DiscPlace disc;
  disc.centre = Vec3{random.uniform(-600, 600), random.uniform(-450, 450), random.uniform(1800, 2600)};
  disc.normal = exp_rotation({random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8), 0}) * Vec3(0, 0, -1);
  disc.radius_mm = random.uniform(3, 12);
  return disc;
}

TEST(OutlineOfDisc, HasTheExactConicOfAPinhole) {
  const Lens lens = lens_with(0);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const DiscPlace disc = random_disc(i);
    const auto conic = image_of_disc(lens, {disc.centre, disc.normal, disc.radius_mm});
    ASSERT_TRUE(conic);
    const Ellipse ellipse = moments_of(outline_of_disc(lens, disc)).ellipse;
    EXPECT_LT((ellipse.centre - conic->centre).norm(), 1e-6);
    EXPECT_NEAR(ellipse.semi_major, conic->semi_major, 1e-5 * conic->semi_major);
    EXPECT_NEAR(ellipse.semi_minor, conic->semi_minor, 1e-5 * conic->semi_major);
  }
}

TEST(OutlineOfDisc, AgreesWithTheLinearisedConicThroughDistortionToAThousandthOfAPixel) {
  const Lens lens = lens_with(5);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const DiscPlace disc = random_disc(i);
    const auto conic = image_of_disc(lens, {disc.centre, disc.normal, disc.radius_mm});
    ASSERT_TRUE(conic);
    EXPECT_LT((moments_of(outline_of_disc(lens, disc)).ellipse.centre - conic->centre).norm(), 1e-3);
  }
}

TEST(MomentsOf, KnowsARectanglesMomentsInEitherSense) {
  // Sides 6 × 2 about (1001, 502): variances 3 and 1/3, so the ellipse has semi-axes 2√3 and 2/√3.
  Outline outline = {{998, 501}, {1004, 501}, {1004, 503}, {998, 503}};
  for (int sense = 0; sense < 2; ++sense) {
    const OutlineMoments moments = moments_of(outline);
    EXPECT_NEAR(moments.area_px2, 12, 1e-9);
    EXPECT_LT((moments.ellipse.centre - Vec2(1001, 502)).norm(), 1e-9);
    EXPECT_NEAR(moments.ellipse.semi_major, 2 * std::numbers::sqrt3, 1e-9);
    EXPECT_NEAR(moments.ellipse.semi_minor, 2 / std::numbers::sqrt3, 1e-9);
    std::reverse(outline.begin(), outline.end());
  }
}

TEST(OutlineOfDisc, IsEmptyWhenTheRimReachesBehindTheCamera) {
  EXPECT_TRUE(outline_of_disc(lens_with(0), {{0, 0, 3}, Vec3::UnitX(), 5}).empty());
}

}  // namespace
}  // namespace asterism
