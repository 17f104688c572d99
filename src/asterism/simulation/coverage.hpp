// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/simulation/outline.hpp"

namespace asterism {

/// A window of an image divided more finely than its pixels: cell (i, j) covers the square of 1/parts px
/// whose corner is x0 + i/parts − ½, y0 + j/parts − ½ (pixel centres are at whole numbers).
struct FineGrid {
  int x0 = 0, y0 = 0;          // first pixel
  int width = 0, height = 0;   // pixels
  int parts = 1;               // cells a pixel, along each axis
  std::vector<double> values;  // rows of width · parts

  FineGrid(int first_x, int first_y, int pixels_wide, int pixels_high, int parts_a_pixel);
  [[nodiscard]] int columns() const { return width * parts; }
  [[nodiscard]] int rows() const { return height * parts; }
  [[nodiscard]] double* row(int j) { return values.data() + static_cast<std::ptrdiff_t>(j) * columns(); }
  [[nodiscard]] const double* row(int j) const {
    return values.data() + static_cast<std::ptrdiff_t>(j) * columns();
  }
  /// The middle of a cell, px.
  [[nodiscard]] Vec2 middle(int i, int j) const {
    return {x0 - 0.5 + (i + 0.5) / parts, y0 - 0.5 + (j + 0.5) / parts};
  }
};

/// Adds `weight` times the share of each cell that the polygon covers: exact, by the areas that its edges
/// sweep (signed, so either sense and any shape will do). What lies outside the window is cut off.
void add_coverage(FineGrid& grid, const Outline& outline, double weight);

/// Blurs by a Gaussian of `sigma_px`, sampled at the cells' spacing. A cell's light is known by its amount
/// alone, so edges come out within a tenth of (cell size)² px of their place.
void blur(FineGrid& grid, double sigma_px);

/// Mean of the cells of each pixel; rows of `width`.
[[nodiscard]] std::vector<double> pixel_means(const FineGrid& grid);

/// Adds `weight` times the share of each pixel's light that the inside of the rim gives when blurred by a
/// Gaussian: by Green's theorem ∮ A(x − X) b(y − Y) dY with b the Gaussian gathered over a pixel and A its
/// integral. Exact to 1e-8 when the rim's points are no farther apart than rim_spacing_px(sigma).
/// `grid.parts` must be 1.
void add_blurred(FineGrid& grid, const Rim& rim, double sigma_px, double weight);
[[nodiscard]] constexpr double rim_spacing_px(double sigma_px) { return 0.6 * sigma_px; }

}  // namespace asterism
