// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/detect.hpp"

#include <gtest/gtest.h>

#include "asterism/detection/rendered_disc.hpp"

namespace asterism {
namespace {

Ellipse disc_at(double x, double y, double size = 8, double angle_rad = 0.4) {
  return {{x, y}, size, 0.82 * size, angle_rad};
}

/// Nine discs of three sizes on a grid with odd sub-pixel phases.
std::vector<Ellipse> nine_discs() {
  std::vector<Ellipse> discs;
  for (int i = 0; i < 9; ++i) {
    discs.push_back(
        disc_at(40.13 + 61.37 * (i % 3), 41.71 + 60.29 * (i / 3), 3 + 2.5 * (i % 3), 0.3 * i - 1.2));
  }
  return discs;
}

Canvas canvas_of(const std::vector<Ellipse>& discs, double background = 20, double amplitude = 180) {
  Canvas canvas(210, 210, background);
  for (const Ellipse& disc : discs) add_disc(canvas, disc, amplitude, 0.7);
  return canvas;
}

const Centre& nearest(const std::vector<Centre>& centres, const Vec2& px) {
  return *std::min_element(centres.begin(), centres.end(), [&](const Centre& a, const Centre& b) {
    return (a.px() - px).norm() < (b.px() - px).norm();
  });
}

TEST(DetectTargets, FindsEveryDiscToAFewThousandthsOfAPixel) {
  RandomStream random(1, 0);
  const auto discs = nine_discs();
  const auto centres = detect_targets(digitise(canvas_of(discs), 1.0, random), {});
  ASSERT_EQ(centres.size(), discs.size());
  for (const Ellipse& disc : discs) {
    const Centre& centre = nearest(centres, disc.centre);
    EXPECT_LT((centre.px() - disc.centre).norm(), 0.015);  // about four standard deviations
    EXPECT_NEAR(centre.ellipse.semi_major, disc.semi_major, 0.06);
    EXPECT_NEAR(centre.amplitude, 180, 3);
    EXPECT_EQ(centre.flags & ~kSmall, 0U);
  }
}

TEST(DetectTargets, DarkDiscsEqualTheInvertedBrightOnes) {
  RandomStream random(2, 0);
  const Raster8 bright = digitise(canvas_of(nine_discs()), 2.0, random);
  Raster8 dark = bright;
  for (auto& grey : dark.pixels) grey = static_cast<std::uint8_t>(255 - grey);
  DetectionOptions options;
  const auto of_bright = detect_targets(bright, options);
  options.polarity = Polarity::Dark;
  const auto of_dark = detect_targets(dark, options);
  ASSERT_EQ(of_dark.size(), of_bright.size());
  for (std::size_t i = 0; i < of_dark.size(); ++i) {
    EXPECT_EQ(of_dark[i].px(), of_bright[i].px());
    EXPECT_EQ(of_dark[i].amplitude, -of_bright[i].amplitude);
    EXPECT_NEAR(of_dark[i].background, 255 - of_bright[i].background, 1e-9);
  }
}

TEST(DetectTargets, FindsNothingWhereThereIsNothing) {
  EXPECT_TRUE(detect_targets(Raster8(), {}).empty());
  EXPECT_TRUE(detect_targets(Raster8(1, 1), {}).empty());
  EXPECT_TRUE(detect_targets(Raster8(2, 700), {}).empty());
  EXPECT_TRUE(detect_targets(Raster8(640, 480), {}).empty());
  Raster8 white(640, 480);
  std::fill(white.pixels.begin(), white.pixels.end(), 255);
  EXPECT_TRUE(detect_targets(white, {}).empty());
}

TEST(DetectTargets, FindsNearlyAllOfTenThousandBlobs) {
  Canvas canvas(1000, 1000, 20);
  for (int i = 0; i < 10000; ++i)
    add_disc(canvas, {{5.2 + 10 * (i % 100), 4.9 + 10 * (i / 100)}, 2.4, 2.1, 0.3}, 180, 0.5, 16);
  RandomStream random(3, 0);
  const auto centres = detect_targets(digitise(canvas, 2.0, random), {});
  // A few of so small discs are refused for a ragged outline; none is found twice.
  EXPECT_GT(centres.size(), 9700U);
  EXPECT_LE(centres.size(), 10000U);
}

TEST(DetectTargets, SixteenBitsEqualEightBitsScaled) {
  RandomStream random(4, 0), same(4, 0);
  const Canvas canvas = canvas_of(nine_discs());
  const Raster8 eight = digitise(canvas, 2.0, random);
  Raster16 sixteen(eight.width, eight.height);
  for (std::size_t i = 0; i < eight.pixels.size(); ++i)
    sixteen.pixels[i] = static_cast<std::uint16_t>(257 * eight.pixels[i]);
  const auto a = detect_targets(eight, {}), b = detect_targets(sixteen, {});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT((a[i].px() - b[i].px()).norm(), 1e-4);  // floats round differently
    EXPECT_NEAR(257 * a[i].amplitude, b[i].amplitude, 5);
    EXPECT_LT((a[i].covariance - b[i].covariance).norm(), 1e-3 * a[i].covariance.norm());
  }
}

TEST(DetectTargets, MovesWithTheImageByWholePixels) {
  RandomStream random(5, 0);
  const Raster8 image = digitise(canvas_of(nine_discs()), 2.0, random);
  Raster8 larger(image.width + 64, image.height + 128);
  std::fill(larger.pixels.begin(), larger.pixels.end(), 20);
  for (int y = 0; y < image.height; ++y) std::copy_n(image.row(y), image.width, larger.row(y + 128) + 64);
  const auto a = detect_targets(image, {}), b = detect_targets(larger, {});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i].px() + Vec2(64, 128) - b[i].px()).norm(), 1e-3);
}

TEST(DetectTargets, GivesTheSameBitsTwice) {
  RandomStream random(6, 0);
  const Raster8 image = digitise(canvas_of(nine_discs()), 2.0, random);
  const auto a = detect_targets(image, {}), b = detect_targets(image, {});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].px(), b[i].px());
    EXPECT_EQ(a[i].covariance, b[i].covariance);
  }
}

TEST(DetectTargets, StatesAnHonestCovariance) {
  const auto discs = nine_discs();
  int inside = 0, all = 0;
  for (std::uint64_t draw = 0; draw < 230; ++draw) {  // 2,070 errors
    RandomStream random(7, draw);
    const auto centres = detect_targets(digitise(canvas_of(discs), 2.0, random), {});
    ASSERT_EQ(centres.size(), discs.size());
    for (const Ellipse& disc : discs) {
      const Centre& centre = nearest(centres, disc.centre);
      const Vec2 error = centre.px() - disc.centre;
      inside += error.dot(centre.covariance.inverse() * error) <= 5.991;
      ++all;
    }
  }
  EXPECT_NEAR(100.0 * inside / all, 95, 1.5);  // three standard deviations of the count
}

TEST(DetectTargets, WeighsShotNoiseAndStaysHonest) {
  const auto discs = nine_discs();
  int inside = 0, all = 0;
  for (std::uint64_t draw = 0; draw < 120; ++draw) {
    RandomStream random(8, draw);
    Canvas canvas = canvas_of(discs, 4, 220);
    for (double& level : canvas.levels) level += std::sqrt(0.03 + level / 41.0) * random.normal();
    for (const Centre& centre : detect_targets(digitise(canvas, 0, random), {})) {
      for (const Ellipse& disc : discs) {
        const Vec2 error = centre.px() - disc.centre;
        if (error.norm() > 1) continue;
        inside += error.dot(centre.covariance.inverse() * error) <= 5.991;
        ++all;
      }
    }
  }
  EXPECT_EQ(all, 120 * 9);
  EXPECT_NEAR(100.0 * inside / all, 95, 2.5);
}

/// Grey levels of nine discs on a flat ground without any noise, bright or dark.
template <class Grey>
Raster<Grey> noise_free(bool dark, double gain) {
  RandomStream none(0, 0);
  return digitise<Grey>(dark ? canvas_of(nine_discs(), 200, -180) : canvas_of(nine_discs()), 0, none, gain);
}

void expect_all_nine(const Image& image, Polarity polarity) {
  DetectionOptions options;
  options.polarity = polarity;
  const auto centres = detect_targets(image, options);
  ASSERT_EQ(centres.size(), 9U);
  for (const Ellipse& disc : nine_discs()) {
    const Centre& centre = nearest(centres, disc.centre);
    EXPECT_LT((centre.px() - disc.centre).norm(), 0.01);
    EXPECT_GT(centre.covariance(0, 0), 0);
    EXPECT_GT(centre.covariance.determinant(), 0);
    EXPECT_LT(centre.covariance.trace(), 0.01 * 0.01);
  }
}

TEST(DetectTargets, NeedsNoNoise) {
  expect_all_nine(noise_free<std::uint8_t>(false, 1), Polarity::Bright);
  expect_all_nine(noise_free<std::uint8_t>(true, 1), Polarity::Dark);
  expect_all_nine(noise_free<std::uint16_t>(false, 257), Polarity::Bright);
  expect_all_nine(noise_free<std::uint16_t>(true, 257), Polarity::Dark);
}

TEST(DetectTargets, FindsDiscsInAnImageOfTwoLevelsWhenToldTheBlur) {
  DetectionOptions options;
  options.blur_px = 0.4;  // of which two levels say nothing
  Raster8 image = noise_free<std::uint8_t>(false, 1);
  for (auto& grey : image.pixels) grey = grey > 110 ? 200 : 20;
  const auto centres = detect_targets(image, options);
  ASSERT_EQ(centres.size(), 9U);
  for (const Ellipse& disc : nine_discs()) {
    const Centre& centre = nearest(centres, disc.centre);
    EXPECT_LT((centre.px() - disc.centre).norm(), 0.3);
    EXPECT_GT(centre.covariance.determinant(), 0);
  }
}

TEST(DetectTargets, FollowsUnevenLight) {
  Canvas canvas = canvas_of(nine_discs(), 0, 60);
  for (int y = 0; y < canvas.height; ++y) {
    for (int x = 0; x < canvas.width; ++x) canvas.at(x, y) += 10 + 0.4 * x + 0.3 * y;
  }
  RandomStream random(9, 0);
  const auto centres = detect_targets(digitise(canvas, 1.0, random), {});
  EXPECT_EQ(centres.size(), 9U);
}

TEST(DetectTargets, LooksOnlyIntoWindows) {
  RandomStream random(10, 0);
  const auto discs = nine_discs();
  const Raster8 image = digitise(canvas_of(discs), 1.0, random);
  const std::vector<SearchWindow> windows = {
      {discs[4].centre, 20}, {discs[4].centre + Vec2(4, 1), 20}, {{-500, 10}, 30}, {{105, 70}, 4}};
  const auto centres = detect_targets(image, windows, {});
  ASSERT_EQ(centres.size(), 1U);
  EXPECT_LT((centres[0].px() - discs[4].centre).norm(), 0.02);
}

TEST(FitTarget, ReachesTheDiscFromAnOffStart) {
  RandomStream random(11, 0);
  const auto discs = nine_discs();
  const Raster8 image = digitise(canvas_of(discs), 1.0, random);
  const Ellipse start = disc_at(discs[8].centre.x() + 1.1, discs[8].centre.y() - 0.9, 7);
  const auto centre = fit_target(image, start, {});
  ASSERT_TRUE(centre);
  EXPECT_LT((centre->px() - discs[8].centre).norm(), 0.015);
}

TEST(FitTarget, NamesTheReasonWhenThereIsNothingToFit) {
  const Raster8 dark(200, 200);
  EXPECT_EQ(fit_target(dark, disc_at(100, 100), {}).error(), FitFailure::NoContrast);
  EXPECT_EQ(fit_target(dark, disc_at(-40, 100), {}).error(), FitFailure::OutsideImage);
  EXPECT_EQ(fit_target(Raster8(), disc_at(3, 3), {}).error(), FitFailure::OutsideImage);
}

}  // namespace
}  // namespace asterism
