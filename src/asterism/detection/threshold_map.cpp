// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/threshold_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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

/// Mean of the lower three quarters of |differences| of normal noise is 0.728 standard deviations.
template <class Grey>
float noise_of(std::array<Grey, kSamples>& differences) {
  constexpr int kKept = kSamples * 3 / 4;
  std::nth_element(differences.begin(), differences.begin() + kKept, differences.end());
  const double sum = std::accumulate(differences.begin(), differences.begin() + kKept, 0.0);
  return static_cast<float>(sum / kKept / 0.728);
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
  std::array<Grey, kSamples> levels{}, differences{};
  unsigned divisor = 0;
  for (int row = 0; row < map.rows; ++row) {
    const int height = std::min(kTile, image.height - row * kTile);
    for (int column = 0; column < map.columns; ++column) {
      const int width = std::min(kTile, image.width - column * kTile);
      for (int j = 0; j < kSamplesDown; ++j) {
        const Grey* line =
            image.row(row * kTile + (2 * j + 1) * height / (2 * kSamplesDown)) + column * kTile;
        for (int i = 0; i < kSamplesAcross; ++i) {
          const int x = (2 * i + 1) * width / (2 * kSamplesAcross);
          const Grey here = tone(line[x]), beside = tone(line[x > 0 ? x - 1 : std::min(1, width - 1)]);
          const auto k = static_cast<std::size_t>(j * kSamplesAcross + i);
          levels[k] = here;
          differences[k] = static_cast<Grey>(here > beside ? here - beside : beside - here);
          if (differences[k] != 0 && divisor != 1)
            divisor = std::gcd(divisor, static_cast<unsigned>(differences[k]));
        }
      }
      constexpr int kQuantile = kSamples * 2 / 5;
      std::nth_element(levels.begin(), levels.begin() + kQuantile, levels.end());
      const auto tile = static_cast<std::size_t>(row * map.columns + column);
      map.background[tile] = levels[kQuantile];
      map.noise[tile] = noise_of(differences);
    }
  }
  map.step = std::max(1U, divisor);
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

void thresholds_of_row(const ThresholdMap& map, int y, double levels, double sigmas,
                       std::vector<float>& blocks) {
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
  blocks.resize(static_cast<std::size_t>(map.columns) * 2);
  float left = of_tile(0);
  for (int column = 0; column < map.columns; ++column) {
    // Block centres lie a quarter tile left and right of the tile's centre.
    const float here = of_tile(column);
    const float right = of_tile(std::min(column + 1, map.columns - 1));
    blocks[static_cast<std::size_t>(2 * column)] = here + 0.25F * (left - here);
    blocks[static_cast<std::size_t>(2 * column) + 1] = here + 0.25F * (right - here);
    left = here;
  }
}

}  // namespace asterism
