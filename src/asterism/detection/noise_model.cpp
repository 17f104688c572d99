// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/noise_model.hpp"

#include <cmath>
#include <numbers>

#include "asterism/detection/patch.hpp"

namespace asterism {
namespace {

constexpr double kReach = 2.7;  // blurs from the edge within which its shape matters

struct Sample {
  double level, variance, pixels;
};

/// Variance of normal noise of deviation `sigma` about `mean` once it is rounded to whole steps.
double rounded_variance(double mean, double sigma) {
  double moment = 0, square = 0;
  const double first = std::floor(mean - 4 * sigma);
  for (double k = first; k <= mean + 4 * sigma + 1; ++k) {
    const double scale = std::numbers::sqrt2 * sigma;
    const double share = 0.5 * (std::erf((k + 0.5 - mean) / scale) - std::erf((k - 0.5 - mean) / scale));
    moment += share * (k - mean);
    square += share * (k - mean) * (k - mean);
  }
  return square - moment * moment;
}

/// Noise smaller than half a step shows itself as hardly any variance where the level is near a whole step,
/// as too much between two. This undoes it: the variance before rounding plus the 1/12 that rounding adds on
/// slopes.
double variance_with_rounding(double level, double variance, double pixels, double step) {
  const double mean = level / step, measured = std::max(variance / (step * step), 0.5 / pixels);
  if (measured > 0.4) return variance;
  double low = 0.05, high = 0.7;
  for (int i = 0; i < 20; ++i) {
    const double sigma = 0.5 * (low + high);
    (rounded_variance(mean, sigma) < measured ? low : high) = sigma;
  }
  return step * step * (low * low + 1.0 / 12);
}

}  // namespace

Scatter scatter_of(const Patch& patch, const std::vector<float>& distance, const EdgeModel& model) {
  const auto reach = static_cast<float>(kReach * model.blur + 0.3);
  double in[3] = {}, out[3] = {};
  for_each_pixel(patch, [&](std::size_t i) {
    const float d = distance[i];
    if (patch.usable[i] == 0 || (d > -reach && d < reach)) return;
    const double grey = patch.grey[i];
    double* sums = d < 0 ? in : out;
    sums[0] += 1;
    sums[1] += grey;
    sums[2] += grey * grey;
  });
  const auto variance = [](const double* s) {
    return s[0] < 4 ? 0.0 : std::max(0.0, (s[2] - s[1] * s[1] / s[0]) / (s[0] - 1));
  };
  Scatter scatter;
  scatter.outside_pixels = out[0] < 4 ? 0 : out[0];
  scatter.outside_level = model.background;
  scatter.outside_variance = variance(out);
  scatter.inside_pixels = in[0] < 4 ? 0 : in[0];
  scatter.inside_level = model.background + model.amplitude;
  scatter.inside_variance = variance(in);
  return scatter;
}

NoiseModel noise_model(const std::vector<Scatter>& scatters, double step) {
  NoiseModel model;
  model.floor = step * step / 12;
  std::vector<Sample> samples;
  for (const Scatter& s : scatters) {
    if (s.outside_pixels > 0)
      samples.push_back({s.outside_level,
                         variance_with_rounding(s.outside_level, s.outside_variance, s.outside_pixels, step),
                         s.outside_pixels});
    if (s.inside_pixels > 0)
      samples.push_back({s.inside_level,
                         variance_with_rounding(s.inside_level, s.inside_variance, s.inside_pixels, step),
                         s.inside_pixels});
  }
  if (samples.empty()) return {model.floor, 0, model.floor};
  double n = 0, sum = 0;
  for (const Sample& s : samples) n += s.pixels, sum += s.pixels * s.variance;
  model.constant = sum / n;
  for (int round = 0; round < 12; ++round) {
    // Each variance is known to a share √(2/n) of itself; far too large ones are texture.
    double w0 = 0, w1 = 0, w2 = 0, v0 = 0, v1 = 0;
    for (const Sample& s : samples) {
      const double expected = model.variance(s.level);
      const double excess = std::max(0.0, s.variance / expected - 1) / 0.5;
      const double weight = s.pixels / (expected * expected) / (1 + excess * excess);
      w0 += weight;
      w1 += weight * s.level;
      w2 += weight * s.level * s.level;
      v0 += weight * s.variance;
      v1 += weight * s.variance * s.level;
    }
    const double spread = w2 * w0 - w1 * w1;
    if (spread < 1e-4 * w0 * w0) {
      model.constant = v0 / w0;
      model.per_level = 0;
    } else {
      model.per_level = (v1 * w0 - v0 * w1) / spread;
      model.constant = (v0 - model.per_level * w1) / w0;
    }
  }
  return model;
}

EdgeNoise edge_noise(const NoiseModel& noise, const Scatter& scatter, const EdgeModel& model) {
  const auto clearly = [](double measured, double expected, double pixels) {
    if (pixels < 8) return expected;
    return measured > expected * (1 + 3.5 * std::sqrt(2 / pixels)) ? measured : expected;
  };
  const double outside =
      clearly(scatter.outside_variance, noise.variance(model.background), scatter.outside_pixels);
  const double inside = clearly(scatter.inside_variance, noise.variance(model.background + model.amplitude),
                                scatter.inside_pixels);
  return {outside, inside - outside};
}

}  // namespace asterism
