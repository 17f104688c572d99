// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/corner_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

constexpr int kSize = 41;

/// A corner at `at` whose edges run along `squares`' columns: sampled 7 × 7 a pixel, blurred by a Gaussian.
std::vector<double> ideal_corner(const Vec2& at, const Mat2& squares, double blur_px) {
  constexpr int kFine = 7;
  constexpr int kWide = kSize * kFine;
  const Mat2 to_square = squares.inverse();
  std::vector<double> fine(kWide * kWide), across(kWide * kWide), result(kSize * kSize);
  for (int y = 0; y < kWide; ++y) {
    for (int x = 0; x < kWide; ++x) {
      const Vec2 px((x + 0.5) / kFine - 0.5, (y + 0.5) / kFine - 0.5);
      const Vec2 square = to_square * (px - at);
      fine[static_cast<std::size_t>(y * kWide + x)] = square.x() * square.y() > 0 ? 180 : 40;
    }
  }
  std::vector<double> kernel;
  const int reach = static_cast<int>(4 * blur_px * kFine);
  for (int i = -reach; i <= reach; ++i)
    kernel.push_back(std::exp(-0.5 * i * i / (blur_px * blur_px * kFine * kFine)));
  const auto blurred = [&](const std::vector<double>& from, int x, int y, bool along_x) {
    double sum = 0, weights = 0;
    for (int i = -reach; i <= reach; ++i) {
      const int u = along_x ? x + i : x, v = along_x ? y : y + i;
      if (u < 0 || v < 0 || u >= kWide || v >= kWide) continue;
      sum += kernel[static_cast<std::size_t>(i + reach)] * from[static_cast<std::size_t>(v * kWide + u)];
      weights += kernel[static_cast<std::size_t>(i + reach)];
    }
    return sum / weights;
  };
  for (int y = 0; y < kWide; ++y) {
    for (int x = 0; x < kWide; ++x)
      across[static_cast<std::size_t>(y * kWide + x)] = blurred(fine, x, y, true);
  }
  for (int y = 0; y < kWide; ++y) {
    for (int x = 0; x < kWide; ++x) {
      result[static_cast<std::size_t>((y / kFine) * kSize + x / kFine)] +=
          blurred(across, x, y, false) / (kFine * kFine);
    }
  }
  return result;
}

Image image_of(const std::vector<double>& grey, double noise, RandomStream& random) {
  Raster16 image(kSize, kSize);
  for (std::size_t i = 0; i < grey.size(); ++i) {
    image.pixels[i] = static_cast<std::uint16_t>(std::lround(100 * (grey[i] + noise * random.normal())));
  }
  return image;
}

const Mat2 kTilted = (Mat2() << 26, -5, 7, 22).finished();

TEST(FitCorner, FindsATiltedBlurredCorner) {
  const Vec2 truth(20.37, 19.81);
  RandomStream random(1, 0);
  const Image image = image_of(ideal_corner(truth, kTilted, 0.8), 0, random);
  const auto fit = fit_corner(image, {truth + Vec2(0.8, -0.7), kTilted});
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->px - truth).norm(), 0.003);  // the sampling's own floor: 1/7 px steps along 25-px edges
  EXPECT_NEAR(fit->blur_px, std::hypot(0.8, std::sqrt(1.0 / 12.0)), 0.03);  // the pixel's own width adds
  EXPECT_NEAR(fit->amplitude, 7000, 100);
}

TEST(FitCorner, StatesAnHonestCovariance) {
  const Vec2 truth(20.37, 19.81);
  const auto grey = ideal_corner(truth, kTilted, 0.8);
  RandomStream quiet(1, 0);
  const auto noiseless = fit_corner(image_of(grey, 0, quiet), {truth, kTilted});
  ASSERT_TRUE(noiseless);
  double sum = 0;
  constexpr int kDraws = 400;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(2, static_cast<std::uint64_t>(i));
    const auto fit = fit_corner(image_of(grey, 3, random), {truth, kTilted});
    ASSERT_TRUE(fit);
    const Vec2 error = fit->px - noiseless->px;
    sum += error.dot(fit->covariance.inverse() * error) / 2;
  }
  // χ² of 800 degrees: standard deviation 5 %.
  EXPECT_NEAR(sum / kDraws, 1.0, 0.2);
}

TEST(FitCorner, NamesTheReasonWhenThereIsNoCorner) {
  const Image flat = Raster8(kSize, kSize);
  EXPECT_EQ(fit_corner(flat, {Vec2(20, 20), kTilted}).error(), CornerFailure::NoContrast);
  EXPECT_EQ(fit_corner(flat, {Vec2(0, 20), kTilted}).error(), CornerFailure::OutsideImage);
  EXPECT_EQ(fit_corner(flat, {Vec2(20, 20), 3 * Mat2::Identity()}).error(), CornerFailure::SquareTooSmall);
}

}  // namespace
}  // namespace asterism
