// SPDX-License-Identifier: Apache-2.0
#include "asterism/camera/disc_image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "asterism/core/random.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {
namespace {

constexpr int kSamples = 4000;

Lens lens_with(int coefficients) {
  Lens lens{2400, 2390, 0.4, 1023.5, 767.5, {}, coefficients, 2048, 1536};
  const std::array<double, 14> values = {-0.18, 0.11, 8e-4,  -6e-4, -0.03, 0.04, 0.01,
                                         -0.01, 5e-4, -3e-4, 4e-4,  2e-4,  0.01, -0.008};
  for (std::size_t i = 0; i < static_cast<std::size_t>(coefficients); ++i) lens.distortion[i] = values[i];
  return lens;
}

/// A closed outline's centroid and the second moments of its area, times 4: for an ellipse its shape matrix.
struct Moments {
  Vec2 centre;
  Mat2 shape;
};

Moments moments_of(const std::function<Vec2(double angle)>& outline) {
  const Vec2 origin = outline(0);
  double area = 0;
  Vec2 first = Vec2::Zero();
  Mat2 second = Mat2::Zero();
  Vec2 from = Vec2::Zero();
  for (int i = 1; i <= kSamples; ++i) {
    const Vec2 to = outline(2 * std::numbers::pi * i / kSamples) - origin;
    const double cross = from.x() * to.y() - from.y() * to.x();
    area += cross / 2;
    first += cross / 6 * (from + to);
    second +=
        cross / 24 * (from * from.transpose() + to * to.transpose() + (from + to) * (from + to).transpose());
    from = to;
  }
  const Vec2 centre = first / area;
  return {origin + centre, 4.0 * (second / area - centre * centre.transpose())};
}

Vec2 on_edge(const Disc& disc, double angle, const Lens& lens) {
  const Vec3 u = disc.normal.unitOrthogonal();
  const Vec3 v = disc.normal.cross(u);
  return project(lens, disc.centre + disc.radius * (std::cos(angle) * u + std::sin(angle) * v)).value().px;
}

Disc random_disc(RandomStream& random) {
  const Vec3 centre(random.uniform(-600, 600), random.uniform(-450, 450), random.uniform(1500, 2500));
  const Vec3 side(random.normal(), random.normal(), random.normal());
  const double tilt = random.uniform(0, rad_from_deg(70));
  const Vec3 towards = -centre.normalized();
  return {centre, exp_rotation(tilt * towards.cross(side).normalized()) * towards, random.uniform(2, 10)};
}

class DiscThrough : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Coefficients, DiscThrough, testing::Values(0, 4, 5, 8, 12, 14));

TEST_P(DiscThrough, CentreIsThatOfItsDenselySampledOutlineToAThousandthOfAPixel) {
  const Lens lens = lens_with(GetParam());
  RandomStream random(31, 0);
  for (int i = 0; i < 60; ++i) {
    const Disc disc = random_disc(random);
    const auto centre = project_disc_centre(lens, disc);
    ASSERT_TRUE(centre);
    const Moments sampled = moments_of([&](double angle) { return on_edge(disc, angle, lens); });
    EXPECT_LT((centre->px - sampled.centre).norm(), 0.001) << "disc " << i;
    const auto ellipse = image_of_disc(lens, disc);
    ASSERT_TRUE(ellipse);
    EXPECT_LT((ellipse->centre - centre->px).norm(), 1e-9);
    // The shape is linearised at the centre: a fifty-thousandth of an area of some hundred px².
    EXPECT_LT((shape_matrix(*ellipse) - sampled.shape).norm(), 5e-4 * sampled.shape.norm()) << "disc " << i;
  }
}

TEST_P(DiscThrough, JacobiansEqualCentralDifferences) {
  const Lens lens = lens_with(GetParam());
  RandomStream random(32, 0);
  for (int i = 0; i < 10; ++i) {
    const Disc disc = random_disc(random);
    const auto at = project_disc_centre(lens, disc);
    ASSERT_TRUE(at);
    for (int axis = 0; axis < 3; ++axis) {
      const auto moved = [&](double by) {
        return project_disc_centre(lens, {disc.centre + by * Vec3::Unit(axis), disc.normal, disc.radius})->px;
      };
      const Vec2 slope = (moved(0.01) - moved(-0.01)) / 0.02;
      EXPECT_LT((slope - at->by_centre.col(axis)).norm(),
                2e-5);  // the lens's own curvature of it is left out
      const auto turned = [&](double by) {
        return project_disc_centre(
                   lens, {disc.centre, exp_rotation(by * Vec3::Unit(axis)) * disc.normal, disc.radius})
            ->px;
      };
      const Vec2 turning = (turned(1e-4) - turned(-1e-4)) / 2e-4;
      // Left out: the turn changes the part the lens's curvature plays, some 0.005 px a radian.
      EXPECT_LT((turning - at->by_normal * Vec3::Unit(axis).cross(disc.normal)).norm(), 0.01);
    }
  }
}

TEST(ProjectDiscCentre, OnTheAxisIsOffByTheClosedFormBias) {
  const Lens lens = lens_with(0);
  const double z = 1500, r = 10;
  for (const double t : {0.0, 0.2, 0.6, 1.0}) {
    const Disc disc{Vec3(0, 0, z), Vec3(std::sin(t), 0, -std::cos(t)), r};
    const double bias =
        lens.fx * r * r * std::sin(t) * std::cos(t) / (z * z - r * r * std::sin(t) * std::sin(t));
    const auto centre = project_disc_centre(lens, disc);
    ASSERT_TRUE(centre);
    EXPECT_NEAR(std::abs(centre->px.x() - lens.cx), bias, 1e-9);
    EXPECT_NEAR(centre->px.y(), lens.cy, 1e-9);
  }
}

TEST(ProjectDiscCentre, OfRadiusZeroIsTheImageOfThePoint) {
  const Lens lens = lens_with(5);
  const Vec3 point(200, -150, 1800);
  const auto centre = project_disc_centre(lens, {point, Vec3::UnitX(), 0});
  ASSERT_TRUE(centre);
  EXPECT_LT((centre->px - project(lens, point)->px).norm(), 1e-12);
  EXPECT_LT((centre->by_centre - project(lens, point)->by_point).norm(), 1e-12);
}

TEST(ProjectDiscCentre, DoesNotAskWhichSideTheNormalPoints) {
  const Lens lens = lens_with(5);
  RandomStream random(33, 0);
  const Disc disc = random_disc(random);
  const auto one = project_disc_centre(lens, disc);
  const auto other = project_disc_centre(lens, {disc.centre, -disc.normal, disc.radius});
  EXPECT_LT((one->px - other->px).norm(), 1e-12);
}

TEST(ProjectDiscCentre, RefusesWhatLiesBehindTheCamera) {
  EXPECT_EQ(project_disc_centre(lens_with(0), {Vec3(0, 0, -100), Vec3::UnitZ(), 5}).error(),
            LensFailure::BehindCamera);
  EXPECT_EQ(image_of_disc(lens_with(0), {Vec3(0, 0, 4), Vec3::UnitZ(), 5}).error(),
            LensFailure::BehindCamera);
}

class SphereThrough : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Coefficients, SphereThrough, testing::Values(0, 5));

TEST_P(SphereThrough, OutlineIsThatOfTheSightLinesWhichTouchIt) {
  const Lens lens = lens_with(GetParam());
  RandomStream random(34, 0);
  for (int i = 0; i < 30; ++i) {
    const Vec3 centre(random.uniform(-600, 600), random.uniform(-450, 450), random.uniform(1500, 2500));
    const double radius = random.uniform(2, 12);
    // Touching points form a circle of radius r √(1 − r²/d²) at d − r²/d along the way to the centre.
    const double d = centre.norm();
    const Disc rim{centre * (1 - radius * radius / (d * d)), centre.normalized(),
                   radius * std::sqrt(1 - radius * radius / (d * d))};
    const Moments sampled = moments_of([&](double angle) { return on_edge(rim, angle, lens); });
    const auto ellipse = image_of_sphere(lens, centre, radius);
    ASSERT_TRUE(ellipse);
    EXPECT_LT((ellipse->centre - sampled.centre).norm(), 0.001);
    EXPECT_LT((shape_matrix(*ellipse) - sampled.shape).norm(), 5e-4 * sampled.shape.norm());
  }
  EXPECT_EQ(image_of_sphere(lens, Vec3(0, 0, 5), 6).error(), LensFailure::BehindCamera);
}

}  // namespace
}  // namespace asterism
