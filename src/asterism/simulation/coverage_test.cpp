// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

Outline circle(const Vec2& centre, double radius, int corners) {
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    outline.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

double area_of(const Outline& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return std::abs(twice) / 2;
}

Rim rim_of_circle(const Vec2& centre, double radius, int points) {
  Rim rim;
  const double step = 2 * std::numbers::pi / points;
  for (int i = 0; i < points; ++i) {
    const Vec2 out(std::cos(i * step), std::sin(i * step));
    rim.push_back({centre + radius * out, radius * step * Vec2(-out.y(), out.x())});
  }
  return rim;
}

double total(const FineGrid& grid) {
  return std::accumulate(grid.values.begin(), grid.values.end(), 0.0) / (grid.parts * grid.parts);
}

Vec2 centroid(const FineGrid& grid) {
  Vec2 sum = Vec2::Zero();
  double weight = 0;
  for (int j = 0; j < grid.rows(); ++j) {
    for (int i = 0; i < grid.columns(); ++i) {
      sum += grid.row(j)[i] * grid.middle(i, j);
      weight += grid.row(j)[i];
    }
  }
  return sum / weight;
}

TEST(AddCoverage, KnowsTheAreasOfARectangleInItsPixels) {
  // From (0.25, 0.5) to (2.0, 1.75): pixel 0 is covered from 0.25 to 0.5, pixel 2 from 1.5 to 2.0.
  for (const bool reversed : {false, true}) {
    Outline outline = {{0.25, 0.5}, {2.0, 0.5}, {2.0, 1.75}, {0.25, 1.75}};
    if (reversed) std::reverse(outline.begin(), outline.end());
    FineGrid grid(-1, 0, 5, 3, 1);
    add_coverage(grid, outline, 2.0);
    const double across[] = {0, 0.25, 1, 0.5, 0};
    const double down[] = {0, 1.0, 0.25};
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 5; ++i) EXPECT_NEAR(grid.row(j)[i], 2 * across[i] * down[j], 1e-12);
    }
  }
}

TEST(AddCoverage, IsTheExactAreaOfASlantedTriangleCellByCell) {
  // The half below the diagonal of a 4 × 4 square: whole cells, half cells, empty cells.
  FineGrid grid(0, 0, 4, 4, 1);
  add_coverage(grid, {{-0.5, -0.5}, {3.5, 3.5}, {-0.5, 3.5}}, 1);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(grid.row(j)[i], i < j ? 1.0 : i == j ? 0.5 : 0.0, 1e-12);
  }
}

TEST(AddCoverage, KeepsAreaAndCentroidOfAnyPolygonAtAnyFineness) {
  for (const int parts : {1, 3, 8}) {
    RandomStream random(2, static_cast<std::uint64_t>(parts));
    for (int i = 0; i < 20; ++i) {
      const Vec2 centre{random.uniform(9, 11), random.uniform(9, 11)};
      const Outline outline = circle(centre, random.uniform(1, 8), 5 + static_cast<int>(random.below(300)));
      FineGrid grid(0, 0, 21, 21, parts);
      add_coverage(grid, outline, 1);
      EXPECT_NEAR(total(grid), area_of(outline), 1e-9);
      if (parts == 1) continue;  // the centroid of cell middles is that of the area up to the cells' size
      EXPECT_LT((centroid(grid) - centre).norm(), 0.02 / (parts * parts));
    }
  }
}

TEST(AddCoverage, CutsOffWhatLiesOutside) {
  FineGrid grid(0, 0, 10, 10, 1);
  add_coverage(grid, {{-5, -5}, {4.5, -5}, {4.5, 30}, {-5, 30}}, 1);
  EXPECT_NEAR(total(grid), 50, 1e-12);
  FineGrid right(0, 0, 10, 10, 1);
  add_coverage(right, {{4.5, -5}, {50, -5}, {50, 30}, {4.5, 30}}, 1);
  EXPECT_NEAR(total(right), 50, 1e-12);
}

TEST(AddBlurred, EqualsADiscDividedVeryFinelyAndThenBlurred) {
  constexpr double kSigma = 0.55;
  const Vec2 centre(10.23, 9.81);
  FineGrid exact(0, 0, 21, 21, 1);
  add_blurred(exact, rim_of_circle(centre, 4.7, 128), kSigma, 1.0);
  // Halving the cells quarters what is left of the difference, so both tend to the same picture.
  double largest[2] = {0, 0};
  for (int finer = 0; finer < 2; ++finer) {
    FineGrid cells(0, 0, 21, 21, finer == 0 ? 8 : 32);
    add_coverage(cells, polygon_of(rim_of_circle(centre, 4.7, 4096)), 1);
    blur(cells, kSigma);
    const std::vector<double> means = pixel_means(cells);
    for (std::size_t i = 0; i < means.size(); ++i) {
      largest[finer] = std::max(largest[finer], std::abs(means[i] - exact.values[i]));
    }
  }
  EXPECT_LT(largest[0], 1e-3);
  EXPECT_LT(largest[1], 5e-5);
}

TEST(AddBlurred, KeepsLightAndCentroidInEitherSense) {
  for (const double sigma : {0.4, 0.8, 3.0}) {
    Rim rim = rim_of_circle({30.2, 29.7}, 6, 300);
    for (int sense = 0; sense < 2; ++sense) {
      FineGrid grid(0, 0, 61, 61, 1);
      add_blurred(grid, rim, sigma, 2.0);
      EXPECT_NEAR(total(grid), 2 * std::numbers::pi * 36, 1e-6);
      // What a pixel's box keeps of the grid's frequency: exp(−2 π² σ²) of the rim's moments.
      EXPECT_LT((centroid(grid) - Vec2(30.2, 29.7)).norm(), 1e-6 + 0.1 * std::exp(-19.7 * sigma * sigma));
      for (RimPoint& point : rim) point.by_step = -point.by_step;
    }
  }
}

TEST(AddBlurred, CutsOffWhatLiesOutside) {
  FineGrid whole(-20, -20, 41, 41, 1);
  FineGrid window(-3, -2, 12, 9, 1);
  const Rim rim = rim_of_circle({0.3, -0.4}, 5, 200);
  add_blurred(whole, rim, 0.7, 1);
  add_blurred(window, rim, 0.7, 1);
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 12; ++i) EXPECT_NEAR(window.row(j)[i], whole.row(j + 18)[i + 17], 1e-9);
  }
}

TEST(Blur, KeepsTheLight) {
  FineGrid grid(0, 0, 31, 31, 4);
  const Outline outline = circle({15.3, 14.8}, 5, 200);
  add_coverage(grid, outline, 1);
  blur(grid, 0.7);
  EXPECT_NEAR(total(grid), area_of(outline), 1e-9);
}

}  // namespace
}  // namespace asterism
