// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/threshold_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "asterism/detection/lanes.hpp"

namespace asterism {
namespace {

constexpr int kSamplesAcross = 8;
constexpr int kSamplesDown = 4;
constexpr int kSamples = kSamplesAcross * kSamplesDown;

/// Where a coordinate lies between tile centres: the lower tile and the share of the upper one.
struct Between {
  int low, high;
  float share;
};

Between between_tiles(double at, int tiles) {
  const double tile = std::clamp((at + 0.5) / ThresholdMap::kTile - 0.5, 0.0, tiles - 1.0);
  const int low = std::min(static_cast<int>(tile), std::max(0, tiles - 2));
  return {low, std::min(low + 1, tiles - 1), static_cast<float>(tile - low)};
}

template <class Grey>
struct Sample {
  alignas(32) std::array<Grey, kSamples> values{};

  /// How many are at most `level`.
  [[nodiscard]] ASTERISM_INLINE int count_up_to(Grey level) const {
    int bits = 0;
    for (std::size_t part = 0; part < sizeof values; part += 32) {
      GreyLanes<Grey> lanes;
      std::memcpy(&lanes, reinterpret_cast<const char*>(values.data()) + part, 32);
      const auto found = reinterpret_cast<WordLanes>(lanes <= level);
      for (int i = 0; i < 4; ++i) bits += __builtin_popcountll(found[i]);
    }
    return bits / static_cast<int>(8 * sizeof(Grey));
  }

  /// The least value that at least `count` samples do not exceed, by bisection over the bits.
  [[nodiscard]] ASTERISM_INLINE Grey quantile(int count) const {
    unsigned below = 0;
    for (unsigned bit = 1U << (8 * sizeof(Grey) - 1); bit != 0; bit >>= 1) {
      if (count_up_to(static_cast<Grey>(below + bit - 1)) < count) below += bit;
    }
    return static_cast<Grey>(below);
  }
};

/// Mean of the lower three quarters of |differences| of normal noise is 0.728 standard deviations.
template <class Grey>
ASTERISM_INLINE float noise_of(const Sample<Grey>& differences) {
  constexpr unsigned kKept = kSamples * 3 / 4;
  const Grey most = differences.quantile(kKept);
  unsigned sum = 0, below = 0;
  for (const Grey value : differences.values) {
    sum += value < most ? value : 0U;
    below += value < most;
  }
  return static_cast<float>((sum + (kKept - below) * most) / (0.728 * kKept));
}

/// What differences between neighbours tell of the grey step.
struct StepSearch {
  unsigned divisor = 0;    // the greatest common divisor of all that were seen
  unsigned different = 0;  // how many were not zero

  ASTERISM_INLINE void see(unsigned difference) {
    if (difference == 0) return;
    ++different;
    if (divisor != 1) divisor = std::gcd(divisor, difference);
  }
};

/// Samples one tile.
template <class Grey>
ASTERISM_INLINE void sample_tile(const Grey* tile, int stride, int width, int height, Tone<Grey> tone,
                                 Sample<Grey>& levels, Sample<Grey>& differences, StepSearch& step) {
  for (int j = 0; j < kSamplesDown; ++j) {
    const Grey* line = tile + static_cast<std::ptrdiff_t>((2 * j + 1) * height / (2 * kSamplesDown)) * stride;
    for (int i = 0; i < kSamplesAcross; ++i) {
      const int x = (2 * i + 1) * width / (2 * kSamplesAcross);
      const Grey here = tone(line[x]), beside = tone(line[x > 0 ? x - 1 : std::min(1, width - 1)]);
      const auto k = static_cast<std::size_t>(j * kSamplesAcross + i);
      const auto difference = static_cast<Grey>(here > beside ? here - beside : beside - here);
      levels.values[k] = here;
      differences.values[k] = difference;
      step.see(difference);
    }
  }
}

/// Background and noise of all tiles.
template <class Grey>
ASTERISM_INLINE StepSearch fill_tiles(const Raster<Grey>& image, Tone<Grey> tone, int columns, int rows,
                                      float* background, float* noise) {
  constexpr int kTile = ThresholdMap::kTile;
  Sample<Grey> levels, differences;
  StepSearch step;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int width = std::min(kTile, image.width - column * kTile);
      const int height = std::min(kTile, image.height - row * kTile);
      sample_tile(image.row(row * kTile) + column * kTile, image.width, width, height, tone, levels,
                  differences, step);
      *background++ = levels.quantile(kSamples * 2 / 5);
      *noise++ = noise_of(differences);
    }
  }
  return step;
}

ASTERISM_CLONES StepSearch fill_tiles_8(const Raster8& image, Tone<std::uint8_t> tone, int columns, int rows,
                                        float* background, float* noise) {
  return fill_tiles(image, tone, columns, rows, background, noise);
}
ASTERISM_CLONES StepSearch fill_tiles_16(const Raster16& image, Tone<std::uint16_t> tone, int columns,
                                         int rows, float* background, float* noise) {
  return fill_tiles(image, tone, columns, rows, background, noise);
}

/// The grey step of the image. Where hardly anything differs (an ideal image without noise) the sample sees
/// too few differences to tell, and every pixel is asked. A step of which the image holds but a handful says
/// nothing of how grey levels are counted: two levels may be any.
template <class Grey>
unsigned step_of(const Raster<Grey>& image, const StepSearch& sampled) {
  constexpr unsigned kEnough = 100, kFewestLevels = 16;
  if (sampled.divisor == 1) return 1;
  unsigned divisor = sampled.divisor;
  if (sampled.different < kEnough) {
    for (int y = 0; y < image.height && divisor != 1; ++y) {
      const Grey* row = image.row(y);
      for (int x = 1; x < image.width; ++x) {
        if (row[x] == row[x - 1]) continue;
        divisor = std::gcd(divisor, static_cast<unsigned>(std::abs(int{row[x]} - int{row[x - 1]})));
      }
    }
  }
  if (divisor <= 1) return 1;
  const auto [least, most] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  return static_cast<unsigned>(*most - *least) < kFewestLevels * divisor ? 1 : divisor;
}

}  // namespace

double ThresholdMap::background_at(double x, double y) const {
  const Between h = between_tiles(x, columns), v = between_tiles(y, rows);
  const float* upper = background.data() + v.low * columns;
  const float* lower = background.data() + v.high * columns;
  const float top = upper[h.low] + h.share * (upper[h.high] - upper[h.low]);
  const float bottom = lower[h.low] + h.share * (lower[h.high] - lower[h.low]);
  return top + v.share * (bottom - top);
}

template <class Grey>
ThresholdMap threshold_map(const Raster<Grey>& image, Tone<Grey> tone) {
  constexpr int kTile = ThresholdMap::kTile;
  ThresholdMap map;
  map.columns = (image.width + kTile - 1) / kTile;
  map.rows = (image.height + kTile - 1) / kTile;
  map.background.resize(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
  map.noise.resize(map.background.size());
  StepSearch step;
  if constexpr (sizeof(Grey) == 1) {
    step = fill_tiles_8(image, tone, map.columns, map.rows, map.background.data(), map.noise.data());
  } else {
    step = fill_tiles_16(image, tone, map.columns, map.rows, map.background.data(), map.noise.data());
  }
  map.step = step_of(image, step);
  return map;
}

template ThresholdMap threshold_map(const Raster8&, Tone<std::uint8_t>);
template ThresholdMap threshold_map(const Raster16&, Tone<std::uint16_t>);

ThresholdMap lowered(const ThresholdMap& map, int reach) {
  ThresholdMap low = map;
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      float least = map.background[static_cast<std::size_t>(row * map.columns + column)];
      for (int j = std::max(0, row - reach); j <= std::min(map.rows - 1, row + reach); ++j) {
        for (int i = std::max(0, column - reach); i <= std::min(map.columns - 1, column + reach); ++i) {
          least = std::min(least, map.background[static_cast<std::size_t>(j * map.columns + i)]);
        }
      }
      low.background[static_cast<std::size_t>(row * map.columns + column)] = least;
    }
  }
  return low;
}

template <class Grey>
void thresholds_of_row(const ThresholdMap& map, int y, double levels, double sigmas,
                       std::vector<Grey>& thresholds) {
  constexpr int kBlock = ThresholdMap::kTile / 2;
  constexpr float kMost = std::numeric_limits<Grey>::max();
  const Between v = between_tiles(y, map.rows);
  const auto least = static_cast<float>(levels * map.step);
  const auto factor = static_cast<float>(sigmas);
  const auto of_tile = [&](int column) {
    const auto one = [&](int row) {
      const auto tile = static_cast<std::size_t>(row * map.columns + column);
      return map.background[tile] + std::max(least, factor * map.noise[tile]);
    };
    const float top = one(v.low);
    return top + v.share * (one(v.high) - top);
  };
  thresholds.resize(static_cast<std::size_t>(map.columns) * 2 * kBlock);
  float left = of_tile(0);
  for (int column = 0; column < map.columns; ++column) {
    // Block centres lie a quarter tile left and right of the tile's centre.
    const float here = of_tile(column);
    const float right = of_tile(std::min(column + 1, map.columns - 1));
    Grey* block = thresholds.data() + static_cast<std::ptrdiff_t>(column) * 2 * kBlock;
    std::fill_n(block, kBlock, static_cast<Grey>(std::min(kMost, here + 0.25F * (left - here))));
    std::fill_n(block + kBlock, kBlock, static_cast<Grey>(std::min(kMost, here + 0.25F * (right - here))));
    left = here;
  }
}

template void thresholds_of_row(const ThresholdMap&, int, double, double, std::vector<std::uint8_t>&);
template void thresholds_of_row(const ThresholdMap&, int, double, double, std::vector<std::uint16_t>&);

}  // namespace asterism
