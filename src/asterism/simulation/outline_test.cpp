// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(RimOfDisc, HasTheExactConicOfAPinhole) {
  const Lens lens = lens_with(0);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const DiscPlace disc = random_disc(i);
    const auto conic = image_of_disc(lens, {disc.centre, disc.normal, disc.radius_mm});
    ASSERT_TRUE(conic);
    const Ellipse ellipse = moments_of(rim_of_disc(lens, disc)).ellipse;
    EXPECT_LT((ellipse.centre - conic->centre).norm(), 1e-9);
    EXPECT_NEAR(ellipse.semi_major, conic->semi_major, 1e-9 * conic->semi_major);
    EXPECT_NEAR(ellipse.semi_minor, conic->semi_minor, 1e-9 * conic->semi_major);
  }
}

TEST(RimOfDisc, AgreesWithTheLinearisedConicThroughDistortionToAThousandthOfAPixel) {
  const Lens lens = lens_with(5);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const DiscPlace disc = random_disc(i);
    const auto conic = image_of_disc(lens, {disc.centre, disc.normal, disc.radius_mm});
    ASSERT_TRUE(conic);
    EXPECT_LT((moments_of(rim_of_disc(lens, disc)).ellipse.centre - conic->centre).norm(), 1e-3);
  }
}

TEST(PolygonOf, KeepsAreaAndCentroid) {
  const Rim rim = rim_of_disc(lens_with(5), random_disc(3), 200);
  const RimMoments moments = moments_of(rim);
  const Outline outline = polygon_of(rim);
  double area = 0;
  Vec2 first = Vec2::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - moments.ellipse.centre;
    const Vec2 b = outline[(i + 1) % outline.size()] - moments.ellipse.centre;
    const double cone = 0.5 * (a.x() * b.y() - a.y() * b.x());
    area += cone;
    first += cone / 3 * (a + b);
  }
  EXPECT_NEAR(std::abs(area) / moments.area_px2, 1, 1e-6);
  EXPECT_LT((first / area).norm(), 1e-5);
}

TEST(RimOfDisc, IsEmptyWhenTheRimReachesBehindTheCamera) {
  EXPECT_TRUE(rim_of_disc(lens_with(0), {{0, 0, 3}, Vec3::UnitX(), 5}).empty());
}

}  // namespace
}  // namespace asterism
