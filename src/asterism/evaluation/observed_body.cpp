// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/observed_body.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

constexpr double kMadToSigma = 1.4826;
constexpr std::size_t kFewestResiduals = 30;

/// In a camera: a displaced target counts as seen where its image lies, any other near where it should.
bool seen(const ObservedBody& observed, const SightedFrame& frame, std::size_t target, std::size_t side) {
  const auto& sight = frame.sights[target][side];
  return sight && (sight->near || (observed.unsound >> target & 1) != 0);
}

/// Missed so many frames on end, those without an image left aside.
void mark_hidden(const ObserveOptions& options, std::size_t target, std::size_t side,
                 ObservedBody& observed) {
  std::vector<std::size_t> missed;
  const auto end_run = [&] {
    if (missed.size() >= static_cast<std::size_t>(options.hidden_frames)) {
      for (const std::size_t i : missed) observed.unhidden.seen[i][side] &= ~(TargetMask{1} << target);
    }
    missed.clear();
  };
  for (std::size_t i = 0; i < observed.frames.size(); ++i) {
    const SightedFrame& frame = observed.frames[i];
    if (!frame.has_image[side]) continue;
    if (seen(observed, frame, target, side)) {
      end_run();
    } else {
      missed.push_back(i);
    }
  }
  end_run();
}

void count_sights(std::size_t target, ObservedBody& observed) {
  std::array<double, 2> images{}, times{};
  double both_images = 0, both = 0;
  for (const SightedFrame& frame : observed.frames) {
    std::array<bool, 2> here{};
    for (std::size_t side = 0; side < 2; ++side) {
      here[side] = frame.has_image[side] && seen(observed, frame, target, side);
      images[side] += frame.has_image[side] ? 1 : 0;
      times[side] += here[side] ? 1 : 0;
    }
    if (!frame.has_image[0] || !frame.has_image[1]) continue;
    both_images += 1;
    both += here[0] && here[1] ? 1 : 0;
  }
  ObservedTarget& told = observed.targets[target];
  for (std::size_t side = 0; side < 2; ++side)
    told.seen[side] = images[side] > 0 ? times[side] / images[side] : 0;
  told.seen_by_both = both_images > 0 ? both / both_images : 0;
}

/// σ by the median of |residual|, widened by what six parameters a pose took up.
double robust_sigma(std::vector<double> magnitudes, double widening) {
  return kMadToSigma * quantile_of(magnitudes, 0.5) * widening;
}

void measure_noise(const ObserveOptions& options, ObservedBody& observed) {
  std::vector<std::vector<double>> by_target(observed.targets.size());
  std::vector<double> all;
  double poses = 0;
  for (const SightedFrame& frame : observed.frames) {
    if (!frame.measured) continue;
    poses += 1;
    for (std::size_t t = 0; t < by_target.size(); ++t) {
      if ((observed.unsound >> t & 1) != 0) continue;
      for (const auto& sight : frame.sights[t]) {
        if (!sight || !sight->near) continue;
        for (const double r : {std::abs(sight->residual_px.x()), std::abs(sight->residual_px.y())}) {
          by_target[t].push_back(r);
          all.push_back(r);
        }
      }
    }
  }
  const auto count = static_cast<double>(all.size());
  if (!(count > 6 * poses)) return;
  const double widening = std::sqrt(count / (count - 6 * poses));
  observed.sigma_px = robust_sigma(all, widening);
  std::vector<double> sigmas;
  for (std::size_t t = 0; t < by_target.size(); ++t) {
    if (by_target[t].size() < kFewestResiduals) continue;
    observed.targets[t].sigma_px = robust_sigma(by_target[t], widening);
    sigmas.push_back(*observed.targets[t].sigma_px);
  }
  if (sigmas.size() < 3) return;
  const double usual = quantile_of(sigmas, 0.5);
  for (ObservedTarget& target : observed.targets)
    target.noisy = target.sigma_px && *target.sigma_px > options.noisy_ratio * usual;
}

}  // namespace

ObservedBody observe_body(std::span<const TrackedFrame> frames, const Body& body, int body_index,
                          const StereoRig& rig, const ObserveOptions& options) {
  ObservedBody observed;
  observed.frames_in_all = frames.size();
  observed.frames = sighted_frames(frames, body, body_index, rig, options);
  observed.targets.resize(body.targets.size());
  for (const SightedFrame& frame : observed.frames) observed.measured += frame.measured ? 1 : 0;
  const auto displaced = displacements(observed.frames, body, rig, options);
  for (std::size_t t = 0; t < displaced.size(); ++t) {
    observed.targets[t].displaced = displaced[t];
    if (displaced[t]) observed.unsound |= TargetMask{1} << t;
  }
  observed.unhidden.seen.assign(observed.frames.size(), {~TargetMask{0}, ~TargetMask{0}});
  for (std::size_t t = 0; t < body.targets.size(); ++t) {
    for (std::size_t side = 0; side < 2; ++side) mark_hidden(options, t, side, observed);
    count_sights(t, observed);
  }
  measure_noise(options, observed);
  return observed;
}

}  // namespace asterism
