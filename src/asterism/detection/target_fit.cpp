// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/target_fit.hpp"

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

constexpr double kMargin = 5;  // px of background around a target
constexpr BlurPrior kAnyBlur = {0.75, 0.5};

double size_of(const TargetFit& target) {
  const EdgeModel& m = target.fit.model;
  return 1.0 / std::sqrt(m.m11 * m.m22 - m.m12 * m.m12);
}

/// The blur is not fitted on small discs, where it cannot be told from size and brightness.
BlurPrior prior_for(double size, const DetectionOptions& options, double image_blur) {
  if (options.blur_px > 0) return {options.blur_px, 0};
  if (size < options.blur_held_below_px) return {image_blur, 0};
  return {image_blur, 0.5};
}

/// The median blur of targets large enough to tell it.
double blur_of(std::span<const TargetFit> targets, const DetectionOptions& options) {
  if (options.blur_px > 0) return options.blur_px;
  std::vector<double> blurs;
  for (const TargetFit& target : targets) {
    if (size_of(target) >= options.blur_held_below_px) blurs.push_back(target.fit.model.blur);
  }
  if (blurs.empty()) return kAnyBlur.mean;
  const auto middle = blurs.begin() + static_cast<std::ptrdiff_t>(blurs.size() / 2);
  std::nth_element(blurs.begin(), middle, blurs.end());
  return *middle;
}

/// Leaves only pixels up to `reach` px outside of the edge: what lies beyond says nothing of the centre but
/// may differ from the background at the edge (the target's own mount, shadows).
void narrow(TargetFit& target, double reach) {
  Patch& patch = target.patch;
  fill_spans(patch, ellipse_of(patch, target.fit.model), reach);
  for_each_pixel(patch, [&](std::size_t i) {
    if (target.content.distance[i] > static_cast<float>(reach)) patch.usable[i] = 0;
  });
}

}  // namespace

template <class Grey>
Result<TargetFit, FitFailure> first_fit(const Raster<Grey>& image, Tone<Grey> tone, const GreyScale& scale,
                                        const Ellipse& start, const DetectionOptions& options) {
  TargetFit target;
  target.patch = cut_patch(image, tone, scale, start, kMargin);
  target.content = look_at(target.patch, start);
  const PatchContent& content = target.content;
  if (2 * content.disc_pixels < std::numbers::pi * start.semi_major * start.semi_minor) {
    return because(FitFailure::OutsideImage);
  }
  const double contrast = content.inside - content.outside;
  if (contrast < options.min_contrast_levels * scale.step / scale.ceiling)
    return because(FitFailure::NoContrast);
  mask_neighbours(target.patch, target.content);
  EdgeModel model = model_of(target.patch, start);
  model.amplitude = contrast;
  model.background = content.outside;
  model.blur = options.blur_px > 0 ? options.blur_px : kAnyBlur.mean;
  target.blur = prior_for(std::sqrt(start.semi_major * start.semi_minor), options, model.blur);
  // One hundredth of the contrast puts the prior on the blur in proportion before the noise is known.
  const auto fit =
      fit_edge(target.patch, model, {}, {1e-4 * contrast * contrast, 0}, target.blur, {20, 0.05});
  if (!fit) return because(fit.error());
  target.fit = *fit;
  target.scatter = scatter_of(target.patch, content.distance, fit->model);
  if (20 * content.saturated > content.disc_pixels) target.flags |= kSaturated;
  if (content.border) target.flags |= kBorder;
  if (content.neighbour_near) target.flags |= kTouching;
  return target;
}

template Result<TargetFit, FitFailure> first_fit(const Raster8&, Tone<std::uint8_t>, const GreyScale&,
                                                 const Ellipse&, const DetectionOptions&);
template Result<TargetFit, FitFailure> first_fit(const Raster16&, Tone<std::uint16_t>, const GreyScale&,
                                                 const Ellipse&, const DetectionOptions&);

ImageTraits traits_of(std::span<const TargetFit> targets, double step, const DetectionOptions& options) {
  std::vector<Scatter> scatters;
  for (const TargetFit& target : targets) scatters.push_back(target.scatter);
  return {noise_model(scatters, step), blur_of(targets, options), {}, 1};
}

bool refit(TargetFit& target, const ImageTraits& traits, const DetectionOptions& options) {
  EdgeModel model = target.fit.model;
  target.blur = prior_for(size_of(target), options, traits.blur_px);
  if (target.blur.deviation == 0) {
    model.blur = target.blur.mean;
    if (options.blur_px == 0) target.flags |= kSmall;
  }
  narrow(target, std::clamp(4.5 * model.blur, 3.0, kMargin));
  target.noise = edge_noise(traits.noise, target.scatter, model);
  const auto fit = fit_edge(target.patch, model, traits.profile, target.noise, target.blur);
  if (fit) target.fit = *fit;
  return fit.has_value();
}

double reduced_chi_square(const TargetFit& target) {
  return target.fit.chi_square / std::max(1.0, target.fit.pixels - EdgeModel::kParameters);
}

double median_chi_square(std::span<const TargetFit> targets) {
  std::vector<double> values;
  for (const TargetFit& target : targets) values.push_back(reduced_chi_square(target));
  if (values.empty()) return 1;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Grey>
Centre centre_of(const TargetFit& target, Tone<Grey> tone, const GreyScale& scale) {
  Centre centre;
  const EdgeModel& model = target.fit.model;
  centre.ellipse = ellipse_of(target.patch, model);
  centre.flags = target.flags;
  centre.covariance = target.fit.covariance;
  // What the model leaves beyond the noise counts as noise, once it is clearly there.
  const double chi_square = reduced_chi_square(target);
  if (chi_square > 1 + 3 * std::sqrt(2 / target.fit.pixels)) centre.covariance *= chi_square;
  const double sign = tone.flip != 0 ? -1 : 1;
  centre.amplitude = sign * model.amplitude * scale.ceiling;
  centre.background = model.background * scale.ceiling;
  if (tone.flip != 0) centre.background = tone.flip - centre.background;
  return centre;
}

template Centre centre_of(const TargetFit&, Tone<std::uint8_t>, const GreyScale&);
template Centre centre_of(const TargetFit&, Tone<std::uint16_t>, const GreyScale&);

}  // namespace asterism
