// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/blurred_centre.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr int kRadial = 240;
constexpr int kAround = 24;      // a quarter of them is enough by symmetry
constexpr double kFarthest = 4;  // of k σ_b: beyond, nothing is left of the spectrum
constexpr int kSteps = 64;

struct Spectrum {
  std::vector<double> k, power;  // power · k³ dk, without the streak
};

Spectrum spectrum_of(double blur_px, double radius_px) {
  Spectrum spectrum;
  const double step = kFarthest / blur_px / kRadial;
  for (int i = 0; i < kRadial; ++i) {
    const double k = (i + 0.5) * step;
    const double disc = std::cyl_bessel_j(1, k * radius_px) / k;
    spectrum.k.push_back(k);
    spectrum.power.push_back(disc * disc * std::exp(-blur_px * blur_px * k * k) * k * k * k);
  }
  return spectrum;
}

/// ∫ (k·u)² |I|² and ∫ (k×u)² |I|², both without factors that do not depend on the streak.
Vec2 information(const Spectrum& spectrum, double streak_px) {
  Vec2 sum = Vec2::Zero();
  for (int j = 0; j < kAround; ++j) {
    const double angle = (j + 0.5) * 0.5 * std::numbers::pi / kAround;
    const double c = std::cos(angle);
    double ring = 0;
    for (int i = 0; i < kRadial; ++i) {
      const double half = 0.5 * spectrum.k[static_cast<std::size_t>(i)] * c * streak_px;
      const double sinc = half < 1e-6 ? 1 : std::sin(half) / half;
      ring += spectrum.power[static_cast<std::size_t>(i)] * sinc * sinc;
    }
    sum += ring * Vec2(c * c, 1 - c * c);
  }
  return sum;
}

}  // namespace

BlurredCentreBound::BlurredCentreBound(const CentreBound& at_rest, double radius_px, double longest_streak_px)
    : step_px_(std::max(1e-3, longest_streak_px) / kSteps) {
  require(radius_px > 0, "a disc has a radius");
  const Spectrum spectrum = spectrum_of(at_rest.blur_px, radius_px);
  const Vec2 still = information(spectrum, 0);
  for (int i = 0; i <= kSteps; ++i) {
    const Vec2 now = information(spectrum, i * step_px_);
    growth_.push_back({std::sqrt(still.x() / now.x()), std::sqrt(still.y() / now.y())});
  }
}

BlurredCentreBound::Growth BlurredCentreBound::growth(double streak_px) const {
  const double place = std::clamp(streak_px / step_px_, 0.0, static_cast<double>(kSteps));
  const auto below = std::min(static_cast<std::size_t>(place), growth_.size() - 2);
  const double share = place - static_cast<double>(below);
  const Growth& a = growth_[below];
  const Growth& b = growth_[below + 1];
  return {a.along + share * (b.along - a.along), a.across + share * (b.across - a.across)};
}

Mat2 BlurredCentreBound::grown(const Mat2& at_rest, const Vec2& streak_px) const {
  const double length = streak_px.norm();
  if (length == 0) return at_rest;
  const Vec2 u = streak_px / length;
  const Growth by = growth(length);
  const Mat2 along = u * u.transpose();
  const Mat2 stretch = by.along * along + by.across * (Mat2::Identity() - along);
  return stretch * at_rest * stretch;
}

}  // namespace asterism
