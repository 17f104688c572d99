// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/simulation/streams.hpp"

namespace asterism {
namespace {

/// The standard normal quantile by Newton on erfc, from a start good to 1 %.
double normal_quantile(double p) {
  const double t = std::sqrt(-2.0 * std::log(std::min(p, 1 - p)));
  double x =
      t - (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
  if (p < 0.5) x = -x;
  for (int i = 0; i < 3; ++i) {
    const double error = 0.5 * std::erfc(-x * std::sqrt(0.5)) - p;
    x -= error * std::sqrt(2.0 * 3.14159265358979323846) * std::exp(0.5 * x * x);
  }
  return x;
}

/// Normal numbers at the price of a table look-up: the means of 65 536 slices of equal probability stand
/// for them. Reaches ±4.3 σ; the variance is set to 1 exactly.
class NormalTable {
 public:
  NormalTable() {
    double sum = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double x = normal_quantile((static_cast<double>(i) + 0.5) / static_cast<double>(values_.size()));
      values_[i] = static_cast<float>(x);
      sum += x * x;
    }
    const auto scale = static_cast<float>(std::sqrt(static_cast<double>(values_.size()) / sum));
    for (float& value : values_) value *= scale;
  }
  [[nodiscard]] float operator[](std::uint32_t i) const { return values_[i]; }

 private:
  std::array<float, 65536> values_{};
};

const NormalTable& normal_table() {
  static const NormalTable table;
  return table;
}

void fill_normal(float* out, int count, RandomStream random) {
  const NormalTable& table = normal_table();
  int i = 0;
  for (; i + 1 < count; i += 2) {
    const std::uint32_t bits = random.bits();
    out[i] = table[bits & 0xFFFFU];
    out[i + 1] = table[bits >> 16];
  }
  if (i < count) out[i] = table[random.bits() & 0xFFFFU];
}

template <class Grey>
Raster<Grey> grey_levels(const Raster<float>& light, const Raster<float>& gain, const Sensor& sensor,
                         Side side, std::uint64_t seed, int frame) {
  Raster<Grey> image(light.width, light.height);
  constexpr auto kCeiling = static_cast<float>(std::numeric_limits<Grey>::max());
  const auto electrons = static_cast<float>(sensor.full_well_e);
  const auto read_variance = static_cast<float>(sensor.read_noise_e * sensor.read_noise_e);
  const float grey_per_electron = kCeiling / electrons;
  const float offset = kCeiling * static_cast<float>(sensor.offset_level) + 0.5F;
  parallel_for(static_cast<std::size_t>(light.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::vector<float> noise(static_cast<std::size_t>(light.width));
    fill_normal(noise.data(), light.width, stream_of(seed, frame, side, Purpose::PixelNoise, y));
    const float* from = light.row(y);
    const float* factor = gain.row(y);
    Grey* to = image.row(y);
    for (int x = 0; x < light.width; ++x) {
      const float e = std::max(0.0F, electrons * from[x] * factor[x]);
      const float noisy = e + std::sqrt(e + read_variance) * noise[static_cast<std::size_t>(x)];
      const float grey = noisy * grey_per_electron + offset;
      to[x] = static_cast<Grey>(std::min(std::max(grey, 0.0F), kCeiling));
    }
  });
  return image;
}

}  // namespace

Raster<float> fixed_pattern(const Sensor& sensor, const Lens& lens, Side side, std::uint64_t seed) {
  Raster<float> gain(lens.width_px, lens.height_px);
  const auto spread = static_cast<float>(sensor.gain_spread);
  parallel_for(static_cast<std::size_t>(gain.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    float* values = gain.row(y);
    fill_normal(values, gain.width, stream_of(seed, 0, side, Purpose::FixedPattern, y));
    for (int x = 0; x < gain.width; ++x) values[x] = 1.0F + spread * values[x];
  });
  return gain;
}

Image expose(const Raster<float>& light, const Raster<float>& gain, const Sensor& sensor, Side side,
             std::uint64_t seed, int frame) {
  require(light.width == gain.width && light.height == gain.height, "light and gain have one size");
  if (sensor.bits == 16) return grey_levels<std::uint16_t>(light, gain, sensor, side, seed, frame);
  return grey_levels<std::uint8_t>(light, gain, sensor, side, seed, frame);
}

}  // namespace asterism
