// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/surface_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "asterism/core/lanes.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/simulation/focus.hpp"
#include "asterism/simulation/triangle_raster.hpp"

namespace asterism {
namespace {

constexpr int kTile_px = 64;
constexpr double kStep_px = 2;  // between instants: finer than what the blur of the way itself shows
constexpr int kMostInstants = 12;
constexpr double kMostBlur_px = 24;
constexpr double kReach = 3.5;  // of the blur, in σ

/// How far the surfaces go in the image from one instant to another: some of their places stand for all.
double farthest(const Scene& begin, const Scene& end, const Lens& lens) {
  constexpr std::size_t kAsked = 16;
  double farthest_px = 0;
  for (std::size_t i = 0; i < begin.surfaces.size(); ++i) {
    const std::vector<Vec3>& places = begin.surfaces[i].surface->places;
    const std::size_t step = places.size() / kAsked + 1;
    for (std::size_t k = 0; k < places.size(); k += step) {
      const auto from = project(lens, begin.surfaces[i].camera_from_carrier * places[k]);
      const auto to = project(lens, end.surfaces[i].camera_from_carrier * places[k]);
      if (from && to) farthest_px = std::max(farthest_px, (to->px - from->px).norm());
    }
  }
  return farthest_px;
}

/// The surfaces of one instant, and which of them reach into each tile.
struct Layer {
  std::vector<ScreenTriangle> triangles;
  std::vector<std::vector<std::int32_t>> by_tile;
};

struct Tiling {
  int columns = 0, rows = 0, reach = 0;
  Tiling(const Raster<float>& image, int reach_px)
      : columns((image.width + kTile_px - 1) / kTile_px),
        rows((image.height + kTile_px - 1) / kTile_px),
        reach(reach_px) {}
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
};

Layer layer_of(const Scene& scene, const Lens& lens) {
  Layer layer;
  for (const SceneSurface& one : scene.surfaces)
    add_screen_triangles(*one.surface, one.camera_from_carrier, lens, layer.triangles);
  return layer;
}

void sort_into(const Tiling& tiling, Layer& layer) {
  layer.by_tile.resize(tiling.count());
  const auto tile = [&](double px, int tiles) {
    return static_cast<int>(std::floor(std::clamp<double>(px / kTile_px, -1, tiles)));
  };
  for (std::size_t i = 0; i < layer.triangles.size(); ++i) {
    const ScreenTriangle& triangle = layer.triangles[i];
    const int first_x = std::max(0, tile(triangle.left - tiling.reach - 1, tiling.columns));
    const int last_x = std::min(tiling.columns - 1, tile(triangle.right + tiling.reach + 1, tiling.columns));
    const int first_y = std::max(0, tile(triangle.top - tiling.reach - 1, tiling.rows));
    const int last_y = std::min(tiling.rows - 1, tile(triangle.bottom + tiling.reach + 1, tiling.rows));
    for (int y = first_y; y <= last_y; ++y) {
      for (int x = first_x; x <= last_x; ++x)
        layer.by_tile[static_cast<std::size_t>(y * tiling.columns + x)].push_back(
            static_cast<std::int32_t>(i));
    }
  }
}

std::vector<float> taps_of(double sigma_px) {
  const int reach = static_cast<int>(std::ceil(kReach * sigma_px));
  std::vector<float> taps;
  float sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    taps.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma_px * sigma_px))));
    sum += taps.back();
  }
  for (float& tap : taps) tap /= sum;
  return taps;
}

/// Adds `tap` times one row to another.
ASTERISM_INLINE void add_row(float* to, const float* from, float tap, int count) {
  constexpr int kLanes = sizeof(FloatLanes) / sizeof(float);
  int x = 0;
  for (; x + kLanes <= count; x += kLanes) {
    FloatLanes sum, more;
    std::memcpy(&sum, to + x, sizeof sum);
    std::memcpy(&more, from + x, sizeof more);
    sum += tap * more;
    std::memcpy(to + x, &sum, sizeof sum);
  }
  for (; x < count; ++x) to[x] += tap * from[x];
}

/// Blurs the middle of a square of `size`; the rim of `reach` around it only gives.
ASTERISM_CLONES void blur_middle(std::vector<float>& values, int size, int reach,
                                 const std::vector<float>& taps) {
  const int half = static_cast<int>(taps.size() / 2);
  const int count = size - 2 * reach;
  std::vector<float> along(values.size(), 0.0F);
  const auto place = [&](int x, int y) { return static_cast<std::ptrdiff_t>(y) * size + x; };
  for (int y = reach - half; y < size - reach + half; ++y) {
    for (int k = -half; k <= half; ++k) {
      add_row(along.data() + place(reach, y), values.data() + place(reach + k, y),
              taps[static_cast<std::size_t>(k + half)], count);
    }
  }
  for (int y = reach; y < size - reach; ++y) {
    float* to = values.data() + place(reach, y);
    std::fill(to, to + count, 0.0F);
    for (int k = -half; k <= half; ++k)
      add_row(to, along.data() + place(reach, y + k), taps[static_cast<std::size_t>(k + half)], count);
  }
}

double mean_depth(const std::vector<Layer>& layers, std::size_t tile) {
  double sum = 0;
  std::size_t count = 0;
  for (const Layer& layer : layers) {
    for (const std::int32_t i : layer.by_tile[tile])
      sum += layer.triangles[static_cast<std::size_t>(i)].depth_mm;
    count += layer.by_tile[tile].size();
  }
  return sum / static_cast<double>(count);
}

/// What draws a tile, apart from where it is.
struct Brush {
  const std::vector<Layer>& layers;
  const Tiling& tiling;
  const Sensor& sensor;
  const Lens& lens;
  float specular;
  int samples;  // a pixel: many instants are samples enough
};

void draw_tile(Raster<float>& light, std::size_t tile, const Brush& brush) {
  const int reach = brush.tiling.reach;
  const int size = kTile_px + 2 * reach;
  const int x0 = static_cast<int>(tile) % brush.tiling.columns * kTile_px;
  const int y0 = static_cast<int>(tile) / brush.tiling.columns * kTile_px;
  const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  std::vector<float> colour(pixels, 0.0F), share(pixels, 0.0F);
  const float weight = 1.0F / static_cast<float>(brush.layers.size());
  bool empty = true;
  for (const Layer& layer : brush.layers) {
    if (layer.by_tile[tile].empty()) continue;
    empty = false;
    SampledTile samples(x0 - reach, y0 - reach, size, brush.samples);
    for (const std::int32_t i : layer.by_tile[tile])
      samples.draw(layer.triangles[static_cast<std::size_t>(i)], i);
    samples.add_light(layer.triangles, brush.specular, weight, colour, share);
  }
  if (empty) return;
  const double sigma =
      std::min(kMostBlur_px, spot_sigma_px(brush.sensor, brush.lens, mean_depth(brush.layers, tile)));
  if (sigma > 0) {
    const std::vector<float> taps = taps_of(sigma);
    blur_middle(colour, size, reach, taps);
    blur_middle(share, size, reach, taps);
  }
  for (int j = 0; j < std::min(kTile_px, light.height - y0); ++j) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(j + reach) * size + reach;
    float* row = light.row(y0 + j) + x0;
    for (int i = 0; i < std::min(kTile_px, light.width - x0); ++i)
      row[i] += colour[static_cast<std::size_t>(at + i)] - share[static_cast<std::size_t>(at + i)] * row[i];
  }
}

/// The widest blur of anything that is drawn.
double widest_blur(const std::vector<Layer>& layers, const Sensor& sensor, const Lens& lens) {
  double widest = sensor.blur_px;
  for (const Layer& layer : layers) {
    for (const ScreenTriangle& triangle : layer.triangles)
      widest = std::max(widest, spot_sigma_px(sensor, lens, triangle.depth_mm));
  }
  return std::min(widest, kMostBlur_px);
}

}  // namespace

void draw_surfaces(Raster<float>& light, std::span<const Scene> scenes, const Lens& lens, const Cell& cell) {
  if (scenes.front().surfaces.empty()) return;
  const double way_px = farthest(scenes.front(), scenes.back(), lens);
  const auto most = std::min<std::size_t>(scenes.size(), kMostInstants);
  const auto count = std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(way_px / kStep_px)), 1, most);
  std::vector<Layer> layers(count);
  parallel_for(count, [&](std::size_t i) {
    layers[i] = layer_of(scenes[(2 * i + 1) * scenes.size() / (2 * count)], lens);
  });
  const Tiling tiling(light, static_cast<int>(std::ceil(kReach * widest_blur(layers, cell.sensor, lens))));
  parallel_for(count, [&](std::size_t i) { sort_into(tiling, layers[i]); });
  const Brush brush{layers,           tiling, cell.sensor, lens, static_cast<float>(cell.light.specular),
                    count < 4 ? 4 : 1};
  parallel_for(tiling.count(), [&](std::size_t tile) { draw_tile(light, tile, brush); });
}

}  // namespace asterism
