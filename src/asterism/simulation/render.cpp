// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/render.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asterism/simulation/disc_light.hpp"
#include "asterism/simulation/silhouette.hpp"
#include "asterism/simulation/streams.hpp"

namespace asterism {
namespace {

// Instants so close that an edge's steps between them vanish in the blur.
constexpr double kStep_px = 0.2;
constexpr int kMostInstants = 64;

Vec2 background_slope(const Cell& cell, const Lens& lens) {
  return {cell.light.gradient_x / lens.width_px, cell.light.gradient_y / lens.height_px};
}

Raster<float> background_of(const Cell& cell, const Lens& lens) {
  Raster<float> light(lens.width_px, lens.height_px);
  const auto step = static_cast<float>(cell.light.background_level * background_slope(cell, lens).x());
  for (int y = 0; y < light.height; ++y) {
    const double middle = 0.5 * (light.width - 1);
    const double at_middle = cell.light.background_level *
                             (1.0 + background_slope(cell, lens).y() * (y - 0.5 * (light.height - 1)));
    const auto first = static_cast<float>(at_middle - step * middle);
    float* row = light.row(y);
    for (int x = 0; x < light.width; ++x) row[x] = std::max(0.0F, first + step * static_cast<float>(x));
  }
  return light;
}

/// The scenes of the exposure: as many as the fastest disc needs.
std::vector<Scene> exposure_of(const Stage& stage, Side side, double time_s) {
  const Cell& cell = stage.cell;
  const Lens& lens = cell.rig.lens(side);
  const double exposure_s = cell.sensor.exposure_s;
  std::vector<Scene> scenes = {scene_of(stage, side, time_s)};
  if (exposure_s <= 0) return scenes;
  const Scene begin = scene_of(stage, side, time_s - 0.5 * exposure_s);
  const Scene end = scene_of(stage, side, time_s + 0.5 * exposure_s);
  double farthest_px = 0;
  for (std::size_t i = 0; i < begin.discs.size(); ++i) {
    const auto from = project(lens, begin.discs[i].place.centre);
    const auto to = project(lens, end.discs[i].place.centre);
    if (from && to) farthest_px = std::max(farthest_px, (to->px - from->px).norm());
  }
  const int count = std::clamp(static_cast<int>(std::ceil(farthest_px / kStep_px)), 1, kMostInstants);
  if (count == 1) return scenes;
  scenes.clear();
  for (int i = 0; i < count; ++i) {
    scenes.push_back(scene_of(stage, side, time_s + exposure_s * ((i + 0.5) / count - 0.5)));
  }
  return scenes;
}

void add_disc(Raster<float>& light, const DiscLight& disc, double level) {
  for (int j = 0; j < disc.height; ++j) {
    const int y = disc.y0 + j;
    if (y < 0 || y >= light.height) continue;
    const double* share = disc.shares.data() + static_cast<std::ptrdiff_t>(j) * disc.width;
    float* row = light.row(y);
    for (int i = 0; i < disc.width; ++i) {
      const int x = disc.x0 + i;
      if (x < 0 || x >= light.width) continue;
      row[x] += static_cast<float>(share[i] * (level - row[x]));
    }
  }
}

/// Specks and short streaks of light: Gaussian spots, most small and round, some drawn out.
void add_glints(Raster<float>& light, const Cell& cell, RandomStream random) {
  const int count = static_cast<int>(random.poisson(cell.light.glints));
  for (int k = 0; k < count; ++k) {
    const double x0 = random.uniform(0, light.width);
    const double y0 = random.uniform(0, light.height);
    const double thin = std::hypot(random.uniform(0.3, 1.5), cell.sensor.blur_px);
    const double long_ = random.uniform() < 0.3 ? thin * random.uniform(2, 12) : thin;
    const double angle = random.uniform(0, std::numbers::pi);
    const double level = cell.light.target_level * random.uniform(0.3, 1.3);
    const Vec2 axis(std::cos(angle), std::sin(angle));
    const int reach = static_cast<int>(std::ceil(4 * long_));
    for (int y = std::max(0, static_cast<int>(y0) - reach);
         y < std::min(light.height, static_cast<int>(y0) + reach + 1); ++y) {
      for (int x = std::max(0, static_cast<int>(x0) - reach);
           x < std::min(light.width, static_cast<int>(x0) + reach + 1); ++x) {
        const double u = ((x - x0) * axis.x() + (y - y0) * axis.y()) / long_;
        const double v = ((y - y0) * axis.x() - (x - x0) * axis.y()) / thin;
        light.row(y)[x] += static_cast<float>(level * std::exp(-0.5 * (u * u + v * v)));
      }
    }
  }
}

/// 1 − v (r / corner)².
void vignette(Raster<float>& light, double strength) {
  if (strength == 0) return;
  const float cx = 0.5F * static_cast<float>(light.width - 1);
  const float cy = 0.5F * static_cast<float>(light.height - 1);
  const float scale = static_cast<float>(strength) / (cx * cx + cy * cy);
  for (int y = 0; y < light.height; ++y) {
    float* row = light.row(y);
    const float dy = static_cast<float>(y) - cy;
    for (int x = 0; x < light.width; ++x) {
      const float dx = static_cast<float>(x) - cx;
      row[x] *= 1.0F - scale * (dx * dx + dy * dy);
    }
  }
}

}  // namespace

Raster<float> render_light(const Stage& stage, Side side, double time_s, std::uint64_t seed, int frame) {
  const Cell& cell = stage.cell;
  const Lens& lens = cell.rig.lens(side);
  Raster<float> light = background_of(cell, lens);
  const std::vector<Scene> scenes = exposure_of(stage, side, time_s);
  paint_silhouettes(light, scenes[scenes.size() / 2], lens, cell.sensor.blur_px);
  for (std::size_t i = 0; i < scenes.front().discs.size(); ++i) {
    const double level = cell.light.target_level * scenes[scenes.size() / 2].discs[i].brightness;
    add_disc(light, light_of_disc(scenes, i, lens, cell.sensor.blur_px), level);
  }
  add_glints(light, cell, stream_of(seed, frame, side, Purpose::Glints));
  vignette(light, cell.light.vignetting);
  return light;
}

}  // namespace asterism
