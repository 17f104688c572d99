// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/render.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "asterism/core/parallel.hpp"
#include "asterism/simulation/disc_light.hpp"
#include "asterism/simulation/streams.hpp"
#include "asterism/simulation/surface_light.hpp"

namespace asterism {
namespace {

// Instants so close that an edge's steps between them vanish in the blur. The most are for what no tracker
// could use any more: a target that crosses half the image while the shutter is open.
constexpr double kStep_px = 0.2;
constexpr double kStepOfBlur = 0.4;
constexpr int kMostInstants = 4096;

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

/// The longest way that a disc's centre goes in the image.
double farthest(const Scene& begin, const Scene& end, const Lens& lens) {
  double farthest_px = 0;
  for (std::size_t i = 0; i < begin.discs.size(); ++i) {
    const auto from = project(lens, begin.discs[i].place.centre);
    const auto to = project(lens, end.discs[i].place.centre);
    if (from && to) farthest_px = std::max(farthest_px, (to->px - from->px).norm());
  }
  return farthest_px;
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
  const double farthest_px = std::max(farthest(begin, scenes[0], lens), farthest(scenes[0], end, lens));
  const double step_px = std::max(kStep_px, kStepOfBlur * cell.sensor.blur_px);
  const int count = std::clamp(static_cast<int>(std::ceil(2 * farthest_px / step_px)), 1, kMostInstants);
  if (count == 1) return scenes;
  scenes.clear();
  for (int i = 0; i < count; ++i) {
    scenes.push_back(scene_of(stage, side, time_s + exposure_s * ((i + 0.5) / count - 0.5)));
  }
  return scenes;
}

void add_disc(Raster<float>& light, const DiscLight& disc) {
  for (int j = 0; j < disc.height; ++j) {
    const int y = disc.y0 + j;
    if (y < 0 || y >= light.height) continue;
    const double* share = disc.shares.data() + static_cast<std::ptrdiff_t>(j) * disc.width;
    float* row = light.row(y);
    for (int i = 0; i < disc.width; ++i) {
      const int x = disc.x0 + i;
      if (x < 0 || x >= light.width) continue;
      row[x] += static_cast<float>(share[i] * (disc.level - row[x]));
    }
  }
}

std::vector<DiscLight> discs_of(const std::vector<Scene>& scenes, const Lens& lens, const Sensor& sensor) {
  std::vector<DiscLight> discs(scenes.front().discs.size());
  parallel_for(discs.size(), [&](std::size_t i) { discs[i] = light_of_disc(scenes, i, lens, sensor); });
  return discs;
}

void add_halo(Raster<float>& light, const Lamp& lamp, const Vec2& centre, double radius_px, double free) {
  constexpr double kUnseen = 2.5e-4;  // of full scale: a sixteenth of a grey level of 8 bits
  const double level = lamp.halo_level * free;
  if (!(level > kUnseen) || lamp.halo_px <= 0) return;
  const double reach = radius_px + lamp.halo_px * std::log(level / kUnseen);
  const auto within = [](double at, int size) { return static_cast<int>(std::clamp<double>(at, 0, size)); };
  const int first_x = within(centre.x() - reach, light.width);
  const int end_x = within(centre.x() + reach + 1, light.width);
  for (int y = within(centre.y() - reach, light.height); y < within(centre.y() + reach + 1, light.height);
       ++y) {
    float* row = light.row(y);
    for (int x = first_x; x < end_x; ++x) {
      const double apart = std::hypot(x - centre.x(), y - centre.y());
      if (apart > reach) continue;
      const double beyond = std::max(0.0, apart - radius_px) / lamp.halo_px;
      row[x] += static_cast<float>(level * std::exp(-beyond));
    }
  }
}

/// Stray light beside the lamps: it falls off from a lamp's rim, and is as strong as the lamp is free.
void add_halos(Raster<float>& light, const Scene& scene, const std::vector<DiscLight>& discs,
               const std::vector<Lamp>& lamps, const Lens& lens) {
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const SceneDisc& disc = scene.discs[i];
    if (disc.body >= 0 || discs[i].shares.empty()) continue;
    const RimMoments moments = moments_of(rim_of_disc(lens, disc.place));
    const double lit = std::accumulate(discs[i].shares.begin(), discs[i].shares.end(), 0.0);
    add_halo(light, lamps[static_cast<std::size_t>(disc.target)], moments.ellipse.centre,
             moments.ellipse.semi_major, std::min(1.0, lit / moments.area_px2));
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
  draw_surfaces(light, scenes, lens, cell);
  const std::vector<DiscLight> discs = discs_of(scenes, lens, cell.sensor);
  for (const DiscLight& disc : discs) add_disc(light, disc);
  add_halos(light, scenes[scenes.size() / 2], discs, cell.lamps, lens);
  add_glints(light, cell, stream_of(seed, frame, side, Purpose::Glints));
  vignette(light, cell.light.vignetting);
  return light;
}

}  // namespace asterism
