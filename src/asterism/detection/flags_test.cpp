// SPDX-License-Identifier: Apache-2.0
// What is unusual about a target must be said, and no wrong centre may come with a small covariance
// unflagged.
#include <gtest/gtest.h>

#include "asterism/detection/detect.hpp"
#include "asterism/detection/rendered_disc.hpp"

namespace asterism {
namespace {

constexpr double kBackground = 20;

/// A disc of 8 px in the middle and one in each corner, for the image's noise and blur.
std::vector<Ellipse> five_discs() {
  std::vector<Ellipse> discs = {{{80.3, 79.6}, 8, 6.6, 0.5}};
  for (const Vec2& corner : {Vec2(25.2, 25.7), Vec2(134.9, 24.4), Vec2(24.6, 135.1), Vec2(135.5, 134.8)}) {
    discs.push_back({corner, 7.5, 6.9, -0.8});
  }
  return discs;
}

Canvas canvas_of(const std::vector<Ellipse>& discs, double amplitude = 180) {
  Canvas canvas(160, 160, kBackground);
  for (const Ellipse& disc : discs) add_disc(canvas, disc, amplitude, 0.7);
  return canvas;
}

const Centre* at(const std::vector<Centre>& centres, const Vec2& px, double within = 6) {
  for (const Centre& centre : centres) {
    if ((centre.px() - px).norm() < within) return &centre;
  }
  return nullptr;
}

double deviations(const Centre& centre, const Vec2& truth) {
  const Vec2 error = centre.px() - truth;
  return std::sqrt(error.dot(centre.covariance.inverse() * error));
}

/// Puts the background where normal · (p − disc's centre) > offset, blurred as the disc is.
void cover(Canvas& canvas, const Vec2& centre, const Vec2& normal, double offset) {
  for (int y = static_cast<int>(centre.y()) - 14; y <= static_cast<int>(centre.y()) + 14; ++y) {
    for (int x = static_cast<int>(centre.x()) - 14; x <= static_cast<int>(centre.x()) + 14; ++x) {
      const double d = normal.dot(Vec2(x, y) - centre) - offset;
      const double covered = 0.5 * std::erfc(-d / 0.757 / std::numbers::sqrt2);
      canvas.at(x, y) = kBackground + (canvas.at(x, y) - kBackground) * (1 - covered);
    }
  }
}

TEST(Flags, ACleanDiscHasNone) {
  RandomStream random(1, 0);
  const auto discs = five_discs();
  for (const Centre& centre : detect_targets(digitise(canvas_of(discs), 2, random), {}))
    EXPECT_EQ(centre.flags, 0U);
}

TEST(Flags, SaturatedWhenTheDiscIsAtTheCeilingAndStillHonest) {
  const auto discs = five_discs();
  for (int draw = 0; draw < 20; ++draw) {
    RandomStream random(2, static_cast<std::uint64_t>(draw));
    const auto centres = detect_targets(digitise(canvas_of(discs, 320), 2, random), {});
    const Centre* centre = at(centres, discs[0].centre);
    ASSERT_NE(centre, nullptr);
    EXPECT_TRUE(centre->flags & kSaturated);
    EXPECT_LT(deviations(*centre, discs[0].centre), 5);
    EXPECT_LT((centre->px() - discs[0].centre).norm(), 0.05);
  }
}

TEST(Flags, BorderWhenTheEdgeReachesBeyondTheImage) {
  RandomStream random(3, 0);
  auto discs = five_discs();
  discs.push_back({{5.5, 80.2}, 7.5, 6.9, 0.1});
  const auto centres = detect_targets(digitise(canvas_of(discs), 2, random), {});
  const Centre* centre = at(centres, discs.back().centre);
  ASSERT_NE(centre, nullptr);
  EXPECT_TRUE(centre->flags & kBorder);
  EXPECT_LT(deviations(*centre, discs.back().centre), 5);
}

TEST(Flags, TouchingWhenANeighbourIsNear) {
  RandomStream random(4, 0);
  auto discs = five_discs();
  discs.push_back({{98.3, 79.6}, 7.5, 6.9, 0.1});  // about 3 px between the edges
  const auto centres = detect_targets(digitise(canvas_of(discs), 2, random), {});
  for (const Ellipse& disc : {discs[0], discs.back()}) {
    const Centre* centre = at(centres, disc.centre);
    ASSERT_NE(centre, nullptr);
    EXPECT_TRUE(centre->flags & kTouching);
    EXPECT_LT((centre->px() - disc.centre).norm(), 0.04);
  }
}

TEST(Flags, SmallWhenTheBlurIsHeld) {
  RandomStream random(5, 0);
  auto discs = five_discs();
  discs[0] = {{80.3, 79.6}, 2, 1.7, 0.5};
  const auto centres = detect_targets(digitise(canvas_of(discs), 2, random), {});
  const Centre* centre = at(centres, discs[0].centre);
  ASSERT_NE(centre, nullptr);
  EXPECT_TRUE(centre->flags & kSmall);
}

TEST(Flags, AnOccludedDiscIsFlaggedOrItsCovarianceHolds) {
  const auto discs = five_discs();
  int found = 0, flagged = 0;
  for (int draw = 0; draw < 200; ++draw) {
    RandomStream random(6, static_cast<std::uint64_t>(draw));
    Canvas canvas = canvas_of(discs);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    cover(canvas, discs[0].centre, {std::cos(angle), std::sin(angle)}, random.uniform(-4, 8));
    const auto centres = detect_targets(digitise(canvas, 2, random), {});
    const Centre* centre = at(centres, discs[0].centre, 8);
    if (centre == nullptr) continue;
    ++found;
    flagged += (centre->flags & kOccluded) != 0;
    // A sliver too thin to be told from noise may move the centre by some hundredths of a pixel.
    if ((centre->flags & kOccluded) == 0 && deviations(*centre, discs[0].centre) > 6) {
      EXPECT_LT((centre->px() - discs[0].centre).norm(), 0.05) << "draw " << draw;
    }
  }
  EXPECT_GT(found, 120);
  EXPECT_GT(flagged, 60);
}

}  // namespace
}  // namespace asterism
