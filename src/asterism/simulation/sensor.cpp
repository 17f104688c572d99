// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/simulation/lanes.hpp"
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

/// What makes grey levels of light; electrons but for the last three.
struct Conversion {
  float full_well, read_variance;
  float grey_per_electron, offset, ceiling;  // the offset with the half that rounds
};

/// Grey levels of lanes of light, not yet cut off behind the point.
ASTERISM_INLINE FloatLanes grey_of(const FloatLanes& light, const FloatLanes& gain, const FloatLanes& noise,
                                   const Conversion& how) {
  FloatLanes electrons = how.full_well * light * gain;
  electrons = electrons > 0 ? electrons : FloatLanes{};
  const FloatLanes variance = electrons + how.read_variance;
  const FloatLanes noisy = electrons + variance * inverse_root(variance) * noise;
  FloatLanes grey = noisy * how.grey_per_electron + how.offset;
  grey = grey > 0 ? grey : FloatLanes{};
  return grey < how.ceiling ? grey : how.ceiling - FloatLanes{};
}

template <class Grey>
ASTERISM_INLINE void fill_row(const float* light, const float* gain, const float* noise, Grey* to, int width,
                              const Conversion& how) {
  int x = 0;
  for (; x + kFloatLanes <= width; x += kFloatLanes) {
    using Lanes __attribute__((vector_size(kFloatLanes * sizeof(Grey)))) = Grey;
    const FloatLanes grey = grey_of(lanes_from(light + x), lanes_from(gain + x), lanes_from(noise + x), how);
    const auto cut = __builtin_convertvector(__builtin_convertvector(grey, IntLanes), Lanes);
    std::memcpy(to + x, &cut, sizeof cut);
  }
  for (; x < width; ++x) {
    const FloatLanes none = {};
    to[x] = static_cast<Grey>(grey_of(light[x] + none, gain[x] + none, noise[x] + none, how)[0]);
  }
}

ASTERISM_CLONES void fill_grey_row(const float* light, const float* gain, const float* noise,
                                   std::uint8_t* to, int width, const Conversion& how) {
  fill_row(light, gain, noise, to, width, how);
}
ASTERISM_CLONES void fill_grey_row(const float* light, const float* gain, const float* noise,
                                   std::uint16_t* to, int width, const Conversion& how) {
  fill_row(light, gain, noise, to, width, how);
}

template <class Grey>
Raster<Grey> grey_levels(const Raster<float>& light, const Raster<float>& gain, const Sensor& sensor,
                         Side side, std::uint64_t seed, int frame) {
  Raster<Grey> image(light.width, light.height);
  constexpr auto kCeiling = static_cast<float>(std::numeric_limits<Grey>::max());
  const auto electrons = static_cast<float>(sensor.full_well_e);
  const Conversion how = {electrons, static_cast<float>(sensor.read_noise_e * sensor.read_noise_e),
                          kCeiling / electrons, kCeiling * static_cast<float>(sensor.offset_level) + 0.5F,
                          kCeiling};
  parallel_for(static_cast<std::size_t>(light.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::vector<float> noise(static_cast<std::size_t>(light.width));
    fill_normal(noise.data(), light.width, stream_of(seed, frame, side, Purpose::PixelNoise, y));
    fill_grey_row(light.row(y), gain.row(y), noise.data(), image.row(y), light.width, how);
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
