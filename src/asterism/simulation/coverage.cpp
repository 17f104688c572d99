// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// Mean of max(t − X, 0) for X uniform in [low, high].
double mean_excess(double t, double low, double high) {
  if (t <= low) return 0;
  if (t >= high) return t - 0.5 * (low + high);
  return 0.5 * (t - low) * (t - low) / (high - low);
}

/// One edge's piece within one row: it crosses the share `swept` of the row's height between columns
/// `low` and `high`. To its right all cells gain `swept`; written as differences between neighbours.
void add_piece(double* row, int columns, double low, double high, double swept) {
  const double last = columns;
  low = std::clamp(low, 0.0, last);
  high = std::clamp(high, 0.0, last);
  double before = 0;
  for (int i = static_cast<int>(low); i < columns; ++i) {
    const double covered = mean_excess(i + 1, low, high) - mean_excess(i, low, high);
    row[i] += swept * (covered - before);
    before = covered;
    if (i >= high) break;
  }
}

/// `a` and `b` in cells, any place.
void add_edge(FineGrid& differences, const Vec2& a, const Vec2& b, double weight) {
  if (a.y() == b.y()) return;
  const bool down = a.y() < b.y();
  const Vec2& top = down ? a : b;
  const Vec2& bottom = down ? b : a;
  const double slope = (bottom.x() - top.x()) / (bottom.y() - top.y());
  const int first = std::max(0, static_cast<int>(std::floor(top.y())));
  const int end = std::min(differences.rows(), static_cast<int>(std::ceil(bottom.y())));
  for (int j = first; j < end; ++j) {
    const double y0 = std::max<double>(j, top.y());
    const double y1 = std::min<double>(j + 1, bottom.y());
    if (y1 <= y0) continue;
    const double x0 = top.x() + slope * (y0 - top.y());
    const double x1 = top.x() + slope * (y1 - top.y());
    add_piece(differences.row(j), differences.columns(), std::min(x0, x1), std::max(x0, x1),
              (down ? -weight : weight) * (y1 - y0));
  }
}

/// The normal distribution and its density at 1/64 σ, between by Taylor's series: to 1e-10, at a tenth of the
/// price of erfc and exp.
class NormalCurve {
 public:
  NormalCurve() {
    for (int i = 0; i < kNodes; ++i) {
      const double z = node(i);
      nodes_[static_cast<std::size_t>(i)] = {
          0.5 * std::erfc(-z / std::numbers::sqrt2),
          std::exp(-0.5 * z * z) * std::numbers::inv_sqrtpi / std::numbers::sqrt2};
    }
  }
  struct Value {
    double cdf, density;
  };
  [[nodiscard]] Value at(double z) const {
    if (z <= -kReach) return {0, 0};
    if (z >= kReach) return {1, 0};
    const int i = static_cast<int>((z + kReach) * kPerSigma + 0.5);
    const double at = node(i), d = z - at;
    const Value& near = nodes_[static_cast<std::size_t>(i)];
    const double curve = at * at - 1;
    return {near.cdf + near.density * d * (1 - d * (at / 2 - d * (curve / 6))),
            near.density * (1 - d * (at - d * (curve / 2 - d * (at * (at * at - 3) / 6))))};
  }

 private:
  static constexpr int kReach = 8, kPerSigma = 64, kNodes = 2 * kReach * kPerSigma + 1;
  static double node(int i) { return static_cast<double>(i) / kPerSigma - kReach; }
  std::array<Value, kNodes> nodes_{};
};

const NormalCurve& normal_curve() {
  static const NormalCurve kCurve;
  return kCurve;
}

/// Gaussian blur of a step: how much of it lies before d, and that summed up: ∫ Φ(u/σ) du up to d.
struct BlurredStep {
  double sigma;
  struct Value {
    double cdf, cumulative;
  };
  [[nodiscard]] Value at(double d) const {
    const NormalCurve::Value normal = normal_curve().at(d / sigma);
    return {normal.cdf, d * normal.cdf + sigma * normal.density};
  }
};

std::vector<double> gaussian_taps(double sigma_cells) {
  const int reach = static_cast<int>(std::ceil(6.0 * sigma_cells));
  std::vector<double> taps(static_cast<std::size_t>(2 * reach + 1));
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double value = std::exp(-0.5 * k * k / (sigma_cells * sigma_cells));
    taps[static_cast<std::size_t>(k + reach)] = value;
    sum += value;
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

/// One point's part of the integral, written as differences along each row. `rise` is room for its columns.
void add_rim_point(FineGrid& differences, const RimPoint& point, const BlurredStep& step, int reach,
                   double weight, std::vector<double>& rise) {
  const Vec2 at = point.px - Vec2(differences.x0, differences.y0);
  const int middle_x = static_cast<int>(std::lround(at.x()));
  const int middle_y = static_cast<int>(std::lround(at.y()));
  const int count = 2 * reach + 2;
  double before = 0;  // A of the column before; each rise is A's step from one to the next
  double edge = step.at(middle_x - reach - 0.5 - at.x()).cumulative;
  for (int k = 0; k < count; ++k) {
    const double next = step.at(middle_x - reach + k + 0.5 - at.x()).cumulative;
    const double a = k + 1 < count ? next - edge : 1.0;
    rise[static_cast<std::size_t>(k)] = a - before;
    before = a;
    edge = next;
  }
  const int first_y = std::max(0, middle_y - reach);
  const int last_y = std::min(differences.height - 1, middle_y + reach);
  const int first_x = middle_x - reach;
  const bool whole = first_x >= 0 && first_x + count <= differences.width;
  double above = step.at(first_y - 0.5 - at.y()).cdf;
  for (int y = first_y; y <= last_y; ++y) {
    const double below = step.at(y + 0.5 - at.y()).cdf;
    const double gathered = weight * point.by_step.y() * (below - above);
    above = below;
    double* row = differences.row(y);
    if (whole) {
      for (int k = 0; k < count; ++k) row[first_x + k] += gathered * rise[static_cast<std::size_t>(k)];
      continue;
    }
    for (int k = 0; k < count && first_x + k < differences.width; ++k)
      row[std::max(0, first_x + k)] += gathered * rise[static_cast<std::size_t>(k)];
  }
}

void add_sums_along_rows(FineGrid& grid, const FineGrid& differences) {
  for (int j = 0; j < grid.rows(); ++j) {
    const double* step = differences.row(j);
    double* value = grid.row(j);
    double sum = 0;
    for (int i = 0; i < grid.columns(); ++i) {
      sum += step[i];
      value[i] += sum;
    }
  }
}

}  // namespace

FineGrid::FineGrid(int first_x, int first_y, int pixels_wide, int pixels_high, int parts_a_pixel)
    : x0(first_x),
      y0(first_y),
      width(pixels_wide),
      height(pixels_high),
      parts(parts_a_pixel),
      values(static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()), 0.0) {}

void add_coverage(FineGrid& grid, const Outline& outline, double weight) {
  FineGrid differences(grid.x0, grid.y0, grid.width, grid.height, grid.parts);
  const auto in_cells = [&](const Vec2& px) {
    return Vec2((px - Vec2(grid.x0 - 0.5, grid.y0 - 0.5)) * grid.parts);
  };
  double twice_area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = in_cells(outline[i]);
    const Vec2 b = in_cells(outline[(i + 1) % outline.size()]);
    twice_area += a.x() * b.y() - b.x() * a.y();
  }
  // With y down, a positive area has its left flank climbing: +weight to the right of climbing edges.
  const double sense = twice_area >= 0 ? weight : -weight;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    add_edge(differences, in_cells(outline[i]), in_cells(outline[(i + 1) % outline.size()]), sense);
  }
  add_sums_along_rows(grid, differences);
}

void blur(FineGrid& grid, double sigma_px) {
  if (sigma_px <= 0) return;
  const std::vector<double> taps = gaussian_taps(sigma_px * grid.parts);
  const int reach = static_cast<int>(taps.size() / 2);
  const int columns = grid.columns();
  const int rows = grid.rows();
  FineGrid along(grid.x0, grid.y0, grid.width, grid.height, grid.parts);
  for (int j = 0; j < rows; ++j) {
    const double* from = grid.row(j);
    double* to = along.row(j);
    for (int i = 0; i < columns; ++i) {
      if (from[i] == 0) continue;
      const int first = std::max(-reach, -i);
      const int last = std::min(reach, columns - 1 - i);
      for (int k = first; k <= last; ++k) to[i + k] += from[i] * taps[static_cast<std::size_t>(k + reach)];
    }
  }
  std::fill(grid.values.begin(), grid.values.end(), 0.0);
  for (int j = 0; j < rows; ++j) {
    for (int k = std::max(-reach, -j); k <= std::min(reach, rows - 1 - j); ++k) {
      const double tap = taps[static_cast<std::size_t>(k + reach)];
      const double* from = along.row(j + k);
      double* to = grid.row(j);
      for (int i = 0; i < columns; ++i) to[i] += tap * from[i];
    }
  }
}

std::vector<double> pixel_means(const FineGrid& grid) {
  std::vector<double> means(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height),
                            0.0);
  const double share = 1.0 / (grid.parts * grid.parts);
  for (int j = 0; j < grid.rows(); ++j) {
    const double* from = grid.row(j);
    double* to = means.data() + static_cast<std::ptrdiff_t>(j / grid.parts) * grid.width;
    for (int i = 0; i < grid.columns(); ++i) to[i / grid.parts] += share * from[i];
  }
  return means;
}

void add_blurred(FineGrid& grid, const Rim& rim, double sigma_px, double weight) {
  require(grid.parts == 1 && sigma_px > 0, "a blurred rim is drawn pixel by pixel");
  const int reach = static_cast<int>(std::ceil(6.0 * sigma_px + 0.5));
  FineGrid differences(grid.x0, grid.y0, grid.width, grid.height, 1);
  // A grows towards +x: a rim that runs with y down its left flank encloses its inside negatively.
  double area = 0;
  for (const RimPoint& point : rim) area += (point.px.x() - rim[0].px.x()) * point.by_step.y();
  const double sense = area > 0 ? -weight : weight;
  std::vector<double> rise(static_cast<std::size_t>(2 * reach + 2));
  for (const RimPoint& point : rim) add_rim_point(differences, point, {sigma_px}, reach, sense, rise);
  add_sums_along_rows(grid, differences);
}

}  // namespace asterism
