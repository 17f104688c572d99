// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "asterism/camera/image.hpp"
#include "asterism/core/random.hpp"
#include "asterism/geometry/ellipse.hpp"

namespace asterism {

/// Grey levels in double precision, for tests and benchmarks of detection.
struct Canvas {
  int width = 0, height = 0;
  std::vector<double> levels;

  Canvas(int w, int h, double background)
      : width(w), height(h), levels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), background) {}
  [[nodiscard]] double& at(int x, int y) { return levels[static_cast<std::size_t>(y * width + x)]; }
};

/// Adds the exact image of an elliptical disc: each pixel is the area integral over its square of the disc
/// convolved with a Gaussian of deviation `blur_px`. Along x the integral is closed form, along y a midpoint
/// rule in the angle y = b sin u, which converges exponentially (the integrand is smooth and periodic).
/// Shares nothing with the model the detector fits: no distance to the ellipse, no curvature.
inline void add_disc(Canvas& canvas, const Ellipse& disc, double amplitude, double blur_px, int nodes = 96) {
  const double root2 = std::numbers::sqrt2 * blur_px;
  const auto cdf = [&](double u) { return 0.5 * std::erfc(-u / root2); };
  const auto ramp = [&](double u) {  // the integral of cdf
    return u * cdf(u) + blur_px / std::sqrt(2 * std::numbers::pi) * std::exp(-u * u / (root2 * root2));
  };
  const Mat2 shape = shape_matrix(disc);
  const double height = std::sqrt(shape(1, 1)), reach = 7 * blur_px + 1;
  const double half_width = std::sqrt(shape(0, 0)) + reach;
  const int x0 = std::max(0, static_cast<int>(disc.centre.x() - half_width));
  const int y0 = std::max(0, static_cast<int>(disc.centre.y() - height - reach));
  const int columns = std::min(canvas.width, static_cast<int>(disc.centre.x() + half_width) + 2) - x0;
  const int rows = std::min(canvas.height, static_cast<int>(disc.centre.y() + height + reach) + 2) - y0;
  if (columns <= 0 || rows <= 0) return;
  std::vector<double> across(static_cast<std::size_t>(columns));
  for (int k = 0; k < nodes; ++k) {
    const double u = std::numbers::pi * ((k + 0.5) / nodes - 0.5);
    const double y = height * std::sin(u), weight = height * std::cos(u) * std::numbers::pi / nodes;
    // The disc spans [middle − half, middle + half] on the line y.
    const double middle = disc.centre.x() + shape(0, 1) / shape(1, 1) * y;
    const double half = std::sqrt(shape.determinant() / shape(1, 1)) * std::cos(u);
    for (int i = 0; i < columns; ++i) {
      const auto until = [&](double x) { return ramp(x - (x0 + i) + 0.5) - ramp(x - (x0 + i) - 0.5); };
      across[static_cast<std::size_t>(i)] = until(middle + half) - until(middle - half);
    }
    for (int j = 0; j < rows; ++j) {
      const double off = y0 + j - disc.centre.y() - y;
      const double share = amplitude * weight * (cdf(off + 0.5) - cdf(off - 0.5));
      if (share == 0) continue;
      double* row = &canvas.at(x0, y0 + j);
      for (int i = 0; i < columns; ++i) row[i] += share * across[static_cast<std::size_t>(i)];
    }
  }
}

/// Rounds to grey levels, after adding normal noise.
template <class Grey = std::uint8_t>
[[nodiscard]] Raster<Grey> digitise(const Canvas& canvas, double noise, RandomStream& random,
                                    double gain = 1) {
  Raster<Grey> image(canvas.width, canvas.height);
  constexpr double kMost = std::numeric_limits<Grey>::max();
  for (std::size_t i = 0; i < canvas.levels.size(); ++i) {
    const double level = canvas.levels[i] + (noise > 0 ? noise * random.normal() : 0.0);
    image.pixels[i] = static_cast<Grey>(std::lround(std::min(std::max(0.0, gain * level), kMost)));
  }
  return image;
}

}  // namespace asterism
