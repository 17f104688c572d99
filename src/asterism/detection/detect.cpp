// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/detect.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

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
  Ellipse ellipse;
  double amplitude = 0, background = 0, blur = 0;
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
    const PatchContent content = mask_neighbours(patch, start);
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
    const auto fit = fit_edge(patch, model, unit_noise(content), prior_for(start, options_, model.blur), 20);
    if (!fit) return because(fit.error());
    return FirstFit{ellipse_of(patch, fit->model), fit->model.amplitude, fit->model.background,
                    fit->model.blur, scatter_of(patch, fit->model)};
  }

  [[nodiscard]] Result<Centre, FitFailure> final(const FirstFit& before, const NoiseModel& noise,
                                                 double image_blur) const {
    Patch patch = cut_patch(image_, tone_, scale_, before.ellipse, kMargin);
    const PatchContent content = mask_neighbours(patch, before.ellipse);
    EdgeModel model = model_of(patch, before.ellipse);
    model.amplitude = before.amplitude;
    model.background = before.background;
    const BlurPrior prior = prior_for(before.ellipse, options_, image_blur);
    model.blur = prior.deviation > 0 ? before.blur : prior.mean;
    const auto fit = fit_edge(patch, model, edge_noise(noise, before.scatter, model), prior, 10);
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
    return {1e-4 * contrast * contrast, 0, 0};
  }

  const Raster<Grey>& image_;
  Tone<Grey> tone_;
  GreyScale scale_;
  const DetectionOptions& options_;
};

/// The median blur of targets large enough to tell it.
double blur_of_image(const std::vector<FirstFit>& fits, const DetectionOptions& options) {
  std::vector<double> blurs;
  for (const FirstFit& fit : fits) {
    if (std::sqrt(fit.ellipse.semi_major * fit.ellipse.semi_minor) >= options.blur_held_below_px)
      blurs.push_back(fit.blur);
  }
  if (options.blur_px > 0) return options.blur_px;
  if (blurs.empty()) return kAnyBlur.mean;
  const auto middle = blurs.begin() + static_cast<std::ptrdiff_t>(blurs.size() / 2);
  std::nth_element(blurs.begin(), middle, blurs.end());
  return *middle;
}

template <class Grey>
std::vector<Centre> fit_all(const Raster<Grey>& image, Tone<Grey> tone,
                            const std::vector<Candidate>& candidates, const GreyScale& scale,
                            const DetectionOptions& options) {
  const Fitting<Grey> fitting(image, tone, scale, options);
  std::vector<FirstFit> firsts;
  std::vector<Scatter> scatters;
  for (const Candidate& candidate : candidates) {
    const auto fit = fitting.first(candidate.ellipse);
    if (!fit) continue;
    firsts.push_back(*fit);
    scatters.push_back(fit->scatter);
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

template <class Grey>
GreyScale scale_of(const Raster<Grey>& image, double step, Tone<Grey> tone) {
  double brightest = 0;
  if (sizeof(Grey) > 1 && tone.flip == 0) {
    brightest = image.pixels.empty() ? 0 : *std::max_element(image.pixels.begin(), image.pixels.end());
  }
  if (tone.flip != 0) return {static_cast<double>(tone.flip), step};
  return grey_scale<Grey>(step, brightest);
}

}  // namespace

std::vector<Centre> detect_targets(const Image& image, const DetectionOptions& options) {
  return std::visit(
      [&]<class Grey>(const Raster<Grey>& raster) -> std::vector<Centre> {
        if (raster.width < 3 || raster.height < 3) return {};
        const auto tone = tone_of<Grey>(options);
        const auto candidates = find_candidates(raster, tone, options);
        const double step = threshold_map(raster, tone).step;
        return fit_all(raster, tone, candidates, scale_of(raster, step, tone), options);
      },
      image);
}

std::vector<Centre> detect_targets(const Image& image, std::span<const SearchWindow> windows,
                                   const DetectionOptions& options) {
  return std::visit(
      [&]<class Grey>(const Raster<Grey>& raster) -> std::vector<Centre> {
        if (raster.width < 3 || raster.height < 3) return {};
        const auto tone = tone_of<Grey>(options);
        const double step = threshold_map(raster, tone).step;
        std::vector<Candidate> candidates;
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
          for (Candidate candidate : find_candidates(part, tone, options)) {
            candidate.ellipse.centre += Vec2(x, y);
            const auto same = [&](const Candidate& other) {
              return (other.ellipse.centre - candidate.ellipse.centre).norm() < other.ellipse.semi_minor;
            };
            if (std::none_of(candidates.begin(), candidates.end(), same)) candidates.push_back(candidate);
          }
        }
        return fit_all(raster, tone, candidates, scale_of(raster, step, tone), options);
      },
      image);
}

Result<Centre, FitFailure> fit_target(const Image& image, const Ellipse& start,
                                      const DetectionOptions& options) {
  return std::visit(
      [&]<class Grey>(const Raster<Grey>& raster) -> Result<Centre, FitFailure> {
        if (raster.width < 3 || raster.height < 3) return because(FitFailure::OutsideImage);
        const auto tone = tone_of<Grey>(options);
        const double step = threshold_map(raster, tone).step;
        const Fitting<Grey> fitting(raster, tone, scale_of(raster, step, tone), options);
        const auto first = fitting.first(start);
        if (!first) return because(first.error());
        return fitting.final(*first, noise_model({first->scatter}, fitting.step()),
                             blur_of_image({*first}, options));
      },
      image);
}

}  // namespace asterism
