// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "asterism/detection/target_fit.hpp"

namespace asterism {
namespace {

constexpr std::size_t kSectors = 12;
constexpr double kClearDeviations = 5;  // standard deviations by which a sector must lie off, and
constexpr double kClearPx = 0.05;       // how far
constexpr double kPartInflation = 4;    // of the covariance when only part of the outline is fitted

/// Which twelfth of the outline a pixel belongs to, in the ellipse's own angle.
std::size_t sector_of(const EdgeModel& model, double dx, double dy) {
  const double u = model.m11 * dx + model.m12 * dy, v = model.m12 * dx + model.m22 * dy;
  const double turn = (std::atan2(v, u) / (2 * std::numbers::pi) + 1.0) * kSectors;
  return static_cast<std::size_t>(turn) % kSectors;
}

/// How far each sector of the outline lies outside of the ellipse, px, and how well that is known.
struct Outline {
  std::array<double, kSectors> offset{}, deviation{};
  std::array<bool, kSectors> seen{};

  [[nodiscard]] bool off(std::size_t k) const {
    return seen[k] && std::abs(offset[k]) > std::max(kClearPx, kClearDeviations * deviation[k]);
  }
  [[nodiscard]] bool sound() const {
    for (std::size_t k = 0; k < kSectors; ++k) {
      if (off(k)) return false;
    }
    return true;
  }
  [[nodiscard]] double median() const {
    std::vector<double> sizes;
    for (std::size_t k = 0; k < kSectors; ++k) {
      if (seen[k]) sizes.push_back(std::abs(offset[k]));
    }
    if (sizes.empty()) return 1e9;
    std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2),
                     sizes.end());
    return sizes[sizes.size() / 2];
  }
};

Outline outline_of(const TargetFit& target, const ImageTraits& traits) {
  const EdgeModel& m = target.fit.model;
  const std::vector<float> distance = distances(target.patch, m);
  std::array<double, kSectors> right{}, weight{};
  const double determinant = m.m11 * m.m22 - m.m12 * m.m12;
  for_each_pixel(target.patch, [&](std::size_t i) {
    if (target.patch.usable[i] == 0 || std::abs(distance[i]) > 3.5 * m.blur) return;
    const auto stride = static_cast<std::size_t>(target.patch.stride);
    const double dx = static_cast<double>(i % stride) - m.x, dy = static_cast<double>(i / stride) - m.y;
    const Vec2 u(m.m11 * dx + m.m12 * dy, m.m12 * dx + m.m22 * dy);
    const Vec2 slope_there(m.m11 * u.x() + m.m12 * u.y(), m.m12 * u.x() + m.m22 * u.y());
    const double curvature = determinant * determinant * std::pow(u.norm() / slope_there.norm(), 3);
    const double t = distance[i] / m.blur + 0.5 * m.blur * curvature;
    const double share = 0.5 * std::erfc(t / std::numbers::sqrt2);
    const double slope = m.amplitude * std::exp(-0.5 * t * t) / (m.blur * std::sqrt(2 * std::numbers::pi));
    const double w = 1.0 / (target.noise.outside + share * target.noise.linear);
    const std::size_t k = sector_of(m, dx, dy);
    right[k] += w * slope * (target.patch.grey[i] - m.background - m.amplitude * share);
    weight[k] += w * slope * slope;
  });
  Outline outline;
  const double most = *std::max_element(weight.begin(), weight.end());
  for (std::size_t k = 0; k < kSectors; ++k) {
    outline.seen[k] = weight[k] > 0.02 * most;
    if (!outline.seen[k]) continue;
    outline.offset[k] = right[k] / weight[k];
    outline.deviation[k] = std::sqrt(std::max(1.0, traits.usual_chi_square) / weight[k]);
  }
  return outline;
}

/// The target with `count` sectors from `first` on left out, fitted anew.
std::optional<TargetFit> without(const TargetFit& target, const ImageTraits& traits, std::size_t first,
                                 std::size_t count) {
  TargetFit part = target;
  const EdgeModel& m = target.fit.model;
  for_each_pixel(part.patch, [&](std::size_t i) {
    const auto row = static_cast<double>(i / static_cast<std::size_t>(part.patch.stride));
    const auto column = static_cast<double>(i % static_cast<std::size_t>(part.patch.stride));
    if ((sector_of(m, column - m.x, row - m.y) + kSectors - first) % kSectors < count)
      part.patch.usable[i] = 0;
  });
  const auto fit = fit_edge(part.patch, m, traits.profile, part.noise, part.blur, {12, 0.01});
  if (!fit) return std::nullopt;
  part.fit = *fit;
  return part;
}

}  // namespace

bool judge_outline(TargetFit& target, const ImageTraits& traits) {
  // Only what the other targets do not show as well, and what chance does not, is worth the look.
  const double usual = std::max(1.0, traits.usual_chi_square);
  if (reduced_chi_square(target) < usual * (1 + 4 * std::sqrt(2 / target.fit.pixels))) return true;
  const Outline whole = outline_of(target, traits);
  if (whole.sound()) return true;
  target.flags |= kOccluded;
  std::optional<TargetFit> best;
  for (const std::size_t count : {std::size_t{3}, std::size_t{5}}) {
    for (std::size_t first = 0; first < kSectors; ++first) {
      auto part = without(target, traits, first, count);
      if (!part || (best && reduced_chi_square(*part) >= reduced_chi_square(*best))) continue;
      if (outline_of(*part, traits).sound()) best = std::move(part);
    }
    if (!best) continue;
    target.fit = best->fit;
    target.fit.covariance *= kPartInflation;
    return true;
  }
  // No arc is good: the centre may be off by a good part of what the outline is off by.
  const double off = *std::max_element(whole.offset.begin(), whole.offset.end(),
                                       [](double a, double b) { return std::abs(a) < std::abs(b); });
  target.flags |= kCoarse;
  target.fit.covariance += off * off * Mat2::Identity();
  return whole.median() < 0.3;
}

}  // namespace asterism
