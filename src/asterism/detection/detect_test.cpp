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

}  // namespace
}  // namespace asterism
