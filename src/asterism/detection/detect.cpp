// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/detect.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "asterism/detection/candidates.hpp"
#include "asterism/detection/edge_fit.hpp"
#include "asterism/detection/noise_model.hpp"
#include "asterism/detection/patch.hpp"

namespace asterism {
namespace {

constexpr double kMargin = 6;  // px of background around a target
constexpr BlurPrior kAnyBlur = {0.75, 0.5};

/// One target between its first fit, with uniform weights, and its final one.
struct FirstFit {
  Patch patch;
  PatchContent content;
  Ellipse ellipse;
  EdgeModel model;
  Scatter scatter;
};

template <class Grey>
Tone<Grey> tone_of(const DetectionOptions& options) {
  return {options.polarity == Polarity::Dark ? static_cast<Grey>(~Grey{0}) : Grey{0}};
}

/// The blur is not fitted on small discs, where it cannot be told from size and brightness.
BlurPrior prior_for(const Ellipse& ellipse, const DetectionOptions& options, double image_blur) {
  if (options.blur_px > 0) return {options.blur_px, 0};
  if (std::sqrt(ellipse.semi_major * ellipse.semi_minor) < options.blur_held_below_px) return {image_blur, 0};
  return {image_blur, 0.5};
}

template <class Grey>
class Fitting {
 public:
  Fitting(const Raster<Grey>& image, Tone<Grey> tone, const GreyScale& scale, const DetectionOptions& options)
      : image_(image), tone_(tone), scale_(scale), options_(options) {}

  [[nodiscard]] Result<FirstFit, FitFailure> first(const Ellipse& start) const {
    Patch patch = cut_patch(image_, tone_, scale_, start, kMargin);
    PatchContent content = look_at(patch, start);
    mask_neighbours(patch, content);
    if (2 * content.disc_pixels < std::numbers::pi * start.semi_major * start.semi_minor) {
      return because(FitFailure::OutsideImage);
    }
    if (content.inside - content.outside < options_.min_contrast_levels * scale_.step / scale_.ceiling) {
      return because(FitFailure::NoContrast);
    }
    EdgeModel model = model_of(patch, start);
    model.amplitude = content.inside - content.outside;
    model.background = content.outside;
    model.blur = options_.blur_px > 0 ? options_.blur_px : kAnyBlur.mean;
    const BlurPrior prior = prior_for(start, options_, model.blur);
    const auto fit = fit_edge(patch, model, unit_noise(content), prior, {20, 0.05});
    if (!fit) return because(fit.error());
    const Scatter scatter = scatter_of(patch, content.distance, fit->model);
    const Ellipse ellipse = ellipse_of(patch, fit->model);
    return FirstFit{std::move(patch), std::move(content), ellipse, fit->model, scatter};
  }

  [[nodiscard]] Result<Centre, FitFailure> final(const FirstFit& before, const NoiseModel& noise,
                                                 double image_blur) const {
    const Patch& patch = before.patch;
    const PatchContent& content = before.content;
    EdgeModel model = before.model;
    const BlurPrior prior = prior_for(before.ellipse, options_, image_blur);
    if (prior.deviation == 0) model.blur = prior.mean;
    const auto fit = fit_edge(patch, model, edge_noise(noise, before.scatter, model), prior);
    if (!fit) return because(fit.error());
    Centre centre;
    centre.ellipse = ellipse_of(patch, fit->model);
    centre.covariance = fit->covariance;
    const double sign = tone_.flip != 0 ? -1 : 1;
    centre.amplitude = sign * fit->model.amplitude * scale_.ceiling;
    centre.background = fit->model.background * scale_.ceiling;
    if (tone_.flip != 0) centre.background = tone_.flip - centre.background;
    if (20 * content.saturated > content.disc_pixels) centre.flags |= kSaturated;
    if (content.border) centre.flags |= kBorder;
    if (content.neighbour_near) centre.flags |= kTouching;
    if (prior.deviation == 0 && options_.blur_px == 0) centre.flags |= kSmall;
    return centre;
  }

  [[nodiscard]] double step() const { return scale_.step / scale_.ceiling; }

 private:
  /// One hundredth of the contrast: puts the prior on the blur in proportion before the noise is known.
  static EdgeNoise unit_noise(const PatchContent& content) {
    const double contrast = content.inside - content.outside;
    return {1e-4 * contrast * contrast, 0};
  }

  const Raster<Grey>& image_;
  Tone<Grey> tone_;
  GreyScale scale_;
  const DetectionOptions& options_;
};

/// The median blur of targets large enough to tell it.
double blur_of_image(std::span<const FirstFit> fits, const DetectionOptions& options) {
  std::vector<double> blurs;
  for (const FirstFit& fit : fits) {
    if (std::sqrt(fit.ellipse.semi_major * fit.ellipse.semi_minor) >= options.blur_held_below_px)
      blurs.push_back(fit.model.blur);
  }
  if (options.blur_px > 0) return options.blur_px;
  if (blurs.empty()) return kAnyBlur.mean;
  const auto middle = blurs.begin() + static_cast<std::ptrdiff_t>(blurs.size() / 2);
  std::nth_element(blurs.begin(), middle, blurs.end());
  return *middle;
}

template <class Grey>
std::vector<Centre> fit_all(const Raster<Grey>& image, Tone<Grey> tone, const FoundCandidates& found,
                            const DetectionOptions& options) {
  const Fitting<Grey> fitting(image, tone, grey_scale<Grey>(tone, found.step, found.brightest), options);
  std::vector<FirstFit> firsts;
  std::vector<Scatter> scatters;
  for (const Candidate& candidate : found.candidates) {
    auto fit = fitting.first(candidate.ellipse);
    if (!fit) continue;
    scatters.push_back(fit->scatter);
    firsts.push_back(std::move(*fit));
  }
  const NoiseModel noise = noise_model(scatters, fitting.step());
  const double blur = blur_of_image(firsts, options);
  std::vector<Centre> centres;
  for (const FirstFit& first : firsts) {
    if (const auto centre = fitting.final(first, noise, blur)) centres.push_back(*centre);
  }
  std::sort(centres.begin(), centres.end(), [](const Centre& a, const Centre& b) {
    return std::pair(a.px().y(), a.px().x()) < std::pair(b.px().y(), b.px().x());
  });
  return centres;
}

}  // namespace

std::vector<Centre> detect_targets(const Image& image, const DetectionOptions& options) {
  return std::visit(
      [&]<class Grey>(const Raster<Grey>& raster) -> std::vector<Centre> {
        if (raster.width < 3 || raster.height < 3) return {};
        const auto tone = tone_of<Grey>(options);
        const auto found = find_candidates(raster, tone, options);
        return fit_all(raster, tone, found, options);
      },
      image);
}

std::vector<Centre> detect_targets(const Image& image, std::span<const SearchWindow> windows,
                                   const DetectionOptions& options) {
  return std::visit(
      [&]<class Grey>(const Raster<Grey>& raster) -> std::vector<Centre> {
        if (raster.width < 3 || raster.height < 3) return {};
        const auto tone = tone_of<Grey>(options);
        FoundCandidates all{{}, 0, 0};
        for (const SearchWindow& window : windows) {
          const auto from = [](double at, int most) {
            return std::clamp(static_cast<int>(std::floor(at)), 0, most);
          };
          const int x = from(window.centre_px.x() - window.radius_px, raster.width);
          const int y = from(window.centre_px.y() - window.radius_px, raster.height);
          const int x_end = from(window.centre_px.x() + window.radius_px + 2, raster.width);
          const int y_end = from(window.centre_px.y() + window.radius_px + 2, raster.height);
          if (x_end - x < 3 || y_end - y < 3) continue;
          Raster<Grey> part(x_end - x, y_end - y);
          for (int row = 0; row < part.height; ++row) {
            std::copy_n(raster.row(y + row) + x, part.width, part.row(row));
          }
          const auto found = find_candidates(part, tone, options);
          all.step = std::gcd(static_cast<int>(all.step), static_cast<int>(found.step));
          all.brightest = std::max(all.brightest, found.brightest);
          for (Candidate candidate : found.candidates) {
            candidate.ellipse.centre += Vec2(x, y);
            const auto same = [&](const Candidate& other) {
              return (other.ellipse.centre - candidate.ellipse.centre).norm() < other.ellipse.semi_minor;
            };
            if (std::none_of(all.candidates.begin(), all.candidates.end(), same))
              all.candidates.push_back(candidate);
          }
        }
        all.step = std::max(1.0, all.step);
        return fit_all(raster, tone, all, options);
      },
      image);
}

Result<Centre, FitFailure> fit_target(const Image& image, const Ellipse& start,
                                      const DetectionOptions& options) {
  return std::visit(
      [&]<class Grey>(const Raster<Grey>& raster) -> Result<Centre, FitFailure> {
        if (raster.width < 3 || raster.height < 3) return because(FitFailure::OutsideImage);
        const auto tone = tone_of<Grey>(options);
        const Fitting<Grey> fitting(raster, tone, grey_scale(raster, tone, start, kMargin), options);
        const auto first = fitting.first(start);
        if (!first) return because(first.error());
        return fitting.final(*first, noise_model({first->scatter}, fitting.step()),
                             blur_of_image({&*first, 1}, options));
      },
      image);
}

}  // namespace asterism
