// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/detect.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asterism/detection/candidates.hpp"
#include "asterism/detection/target_fit.hpp"

namespace asterism {
namespace {

template <class Grey>
Tone<Grey> tone_of(const DetectionOptions& options) {
  return {options.polarity == Polarity::Dark ? static_cast<Grey>(~Grey{0}) : Grey{0}};
}

/// Learns how edges look in this image where a Gaussian blur does not explain them, and fits all again.
void learn_profile(std::vector<TargetFit>& targets, ImageTraits& traits, const DetectionOptions& options) {
  constexpr std::size_t kFewest = 3;     // targets that must agree
  constexpr double kUnexplained = 1.12;  // median reduced χ² of targets from which it is worth while
  constexpr std::uint32_t kOdd = kSaturated | kBorder | kTouching;
  for (int round = 0; round < 2; ++round) {
    traits.usual_chi_square = median_chi_square(targets);
    if (targets.size() < kFewest || traits.usual_chi_square < kUnexplained) return;
    std::vector<ProfileView> views;
    for (const TargetFit& target : targets) {
      if ((target.flags & kOdd) != 0 || reduced_chi_square(target) > 2 * traits.usual_chi_square) continue;
      views.push_back({&target.patch, target.fit.model, target.noise, target.blur});
    }
    if (views.size() < kFewest) return;
    traits.profile = improved_profile(traits.profile, views);
    for (TargetFit& target : targets) static_cast<void>(refit(target, traits, options));
  }
  traits.usual_chi_square = median_chi_square(targets);
}

template <class Grey>
std::vector<Centre> fit_all(const Raster<Grey>& image, Tone<Grey> tone, const FoundCandidates& found,
                            const DetectionOptions& options) {
  const GreyScale scale = grey_scale<Grey>(tone, found.step, found.brightest);
  std::vector<TargetFit> targets;
  for (const Candidate& candidate : found.candidates) {
    auto target = first_fit(image, tone, scale, candidate.ellipse, options);
    if (target) targets.push_back(std::move(*target));
  }
  ImageTraits traits = traits_of(targets, scale.step / scale.ceiling, options);
  std::erase_if(targets, [&](TargetFit& target) { return !refit(target, traits, options); });
  learn_profile(targets, traits, options);
  std::vector<Centre> centres;
  for (TargetFit& target : targets) {
    if (judge_outline(target, traits)) centres.push_back(centre_of(target, tone, scale));
  }
  std::sort(centres.begin(), centres.end(), [](const Centre& a, const Centre& b) {
    return std::pair(a.px().y(), a.px().x()) < std::pair(b.px().y(), b.px().x());
  });
  return centres;
}

/// A part of an image, and where it begins; empty when the window lies outside.
template <class Grey>
struct Part {
  Raster<Grey> image;
  Vec2 origin;
};

template <class Grey>
Part<Grey> part_of(const Raster<Grey>& image, const SearchWindow& window) {
  const auto within = [](double at, int most) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, 1.0 * most));
  };
  const int x = within(window.centre_px.x() - window.radius_px, image.width);
  const int y = within(window.centre_px.y() - window.radius_px, image.height);
  const int x_end = within(window.centre_px.x() + window.radius_px + 2, image.width);
  const int y_end = within(window.centre_px.y() + window.radius_px + 2, image.height);
  Part<Grey> part{{x_end - x, y_end - y}, {x, y}};
  for (int row = 0; row < part.image.height; ++row) {
    std::copy_n(image.row(y + row) + x, part.image.width, part.image.row(row));
  }
  return part;
}

/// What several windows hold, each disc once.
template <class Grey>
FoundCandidates find_in_windows(const Raster<Grey>& image, Tone<Grey> tone,
                                std::span<const SearchWindow> windows, const DetectionOptions& options) {
  FoundCandidates all{{}, 0, 0};
  for (const SearchWindow& window : windows) {
    const Part<Grey> part = part_of(image, window);
    const FoundCandidates found = find_candidates(part.image, tone, options);
    all.step = std::gcd(static_cast<int>(all.step), static_cast<int>(found.step));
    all.brightest = std::max(all.brightest, found.brightest);
    for (Candidate candidate : found.candidates) {
      candidate.ellipse.centre += part.origin;
      const auto same = [&](const Candidate& other) {
        return (other.ellipse.centre - candidate.ellipse.centre).norm() < other.ellipse.semi_minor;
      };
      if (std::none_of(all.candidates.begin(), all.candidates.end(), same))
        all.candidates.push_back(candidate);
    }
  }
  all.step = std::max(1.0, all.step);
  return all;
}

}  // namespace

std::vector<Centre> detect_targets(const Image& image, const DetectionOptions& options) {
  return std::visit(
      [&]<class Grey>(const Raster<Grey>& raster) {
        const auto tone = tone_of<Grey>(options);
        return fit_all(raster, tone, find_candidates(raster, tone, options), options);
      },
      image);
}

std::vector<Centre> detect_targets(const Image& image, std::span<const SearchWindow> windows,
                                   const DetectionOptions& options) {
  return std::visit(
      [&]<class Grey>(const Raster<Grey>& raster) {
        const auto tone = tone_of<Grey>(options);
        return fit_all(raster, tone, find_in_windows(raster, tone, windows, options), options);
      },
      image);
}

Result<Centre, FitFailure> fit_target(const Image& image, const Ellipse& start,
                                      const DetectionOptions& options) {
  return std::visit(
      [&]<class Grey>(const Raster<Grey>& raster) -> Result<Centre, FitFailure> {
        const auto tone = tone_of<Grey>(options);
        const GreyScale scale = grey_scale(raster, tone, start);
        auto target = first_fit(raster, tone, scale, start, options);
        if (!target) return because(target.error());
        const ImageTraits traits = traits_of({&*target, 1}, scale.step / scale.ceiling, options);
        if (!refit(*target, traits, options)) return because(FitFailure::NotConverged);
        if (!judge_outline(*target, traits)) return because(FitFailure::NotConverged);
        return centre_of(*target, tone, scale);
      },
      image);
}

}  // namespace asterism
