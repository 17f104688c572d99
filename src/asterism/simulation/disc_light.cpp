// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/disc_light.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "asterism/simulation/focus.hpp"

namespace asterism {
namespace {

// Cells a pixel where something may hide part of a disc: the edge of what hides it is cut cell by cell.
constexpr int kHiddenParts = 8;

/// A moving disc is cut at many instants, each at another place within the pixels: fewer cells do as well.
int parts_for(std::size_t instants) {
  const double share = std::sqrt(static_cast<double>(instants));
  return std::clamp(static_cast<int>(std::ceil(kHiddenParts / share)), 2, kHiddenParts);
}

/// The disc's image at one instant, and what may hide it there.
struct Instant {
  Rim rim;
  Hiding hiding;
  const DiscPlace* disc;
};

/// As many points as the blur asks for, and enough for a polygon that follows the rim to 1e-4 of its size.
int rim_points(const Rim& coarse, double blur_px) {
  double perimeter = 0;
  for (const RimPoint& point : coarse) perimeter += point.by_step.norm();
  const double spacing = blur_px > 0 ? rim_spacing_px(blur_px) : perimeter;
  return std::max(192, static_cast<int>(std::ceil(1.5 * perimeter / spacing)));
}

/// Those at which the disc shines; none when its rim reaches behind the camera at any.
std::vector<Instant> instants_of(std::span<const Scene> scenes, std::size_t index, const Lens& lens,
                                 double blur_px) {
  std::vector<Instant> instants;
  for (const Scene& scene : scenes) {
    const SceneDisc& disc = scene.discs[index];
    if (disc.brightness <= 0) continue;
    const Rim coarse = rim_of_disc(lens, disc.place, 32);
    if (coarse.empty()) return {};
    instants.push_back(
        {rim_of_disc(lens, disc.place, rim_points(coarse, blur_px)), Hiding(scene, index), &disc.place});
    if (instants.back().rim.empty()) return {};
  }
  return instants;
}

/// The window that holds all rims and the blur. What lies beyond the image's edge still blurs into it, so
/// the window may reach out as far as the blur does.
FineGrid window_around(const std::vector<Instant>& instants, const Lens& lens, double blur_px) {
  Vec2 low = instants[0].rim[0].px;
  Vec2 high = low;
  for (const Instant& instant : instants) {
    for (const RimPoint& point : instant.rim) {
      low = low.cwiseMin(point.px);
      high = high.cwiseMax(point.px);
    }
  }
  const double reach = std::ceil(6.0 * blur_px) + 1;
  const double x0 = std::max(low.x() - reach, -reach), x1 = std::min(high.x() + reach, lens.width_px + reach);
  const double y0 = std::max(low.y() - reach, -reach),
               y1 = std::min(high.y() + reach, lens.height_px + reach);
  if (!(x1 > x0 && y1 > y0)) return {0, 0, 0, 0, 1};
  const int first_x = static_cast<int>(std::floor(x0)), first_y = static_cast<int>(std::floor(y0));
  return {first_x, first_y, static_cast<int>(std::ceil(x1)) - first_x + 1,
          static_cast<int>(std::ceil(y1)) - first_y + 1, 1};
}

/// Puts out the cells whose middle, carried to the disc's plane, is hidden. The lens is taken as linear
/// over the disc's image: a hundredth of a pixel at the edge of what hides it.
void cut_hidden(FineGrid& grid, const Instant& instant, const Lens& lens) {
  const Vec2 middle_px = moments_of(instant.rim).ellipse.centre;
  const auto sight = sight_line(lens, middle_px);
  if (!sight) return;
  const double height = instant.disc->normal.dot(instant.disc->centre);
  for (int j = 0; j < grid.rows(); ++j) {
    double* row = grid.row(j);
    for (int i = 0; i < grid.columns(); ++i) {
      if (row[i] == 0) continue;
      const Vec3 ray = Vec2(sight->xy + sight->by_px * (grid.middle(i, j) - middle_px)).homogeneous();
      if (instant.hiding.hides(ray * (height / instant.disc->normal.dot(ray)))) row[i] = 0;
    }
  }
}

/// Whether hides() can matter: tried at points all over the disc, so what is narrower than the steps between
/// them (a tenth of the disc when it stands still) may slip through.
bool hidden_anywhere(const Instant& instant, int parts) {
  if (!instant.hiding.possible()) return false;
  const DiscPlace& disc = *instant.disc;
  const Vec3 across = disc.normal.unitOrthogonal();
  const Vec3 along = disc.normal.cross(across);
  const int steps = 5 + 2 * parts;
  for (int j = 0; j < steps; ++j) {
    for (int i = 0; i < steps; ++i) {
      const Vec2 at(2.0 * i / (steps - 1) - 1, 2.0 * j / (steps - 1) - 1);
      if (at.norm() > 1.05) continue;
      if (instant.hiding.hides(disc.centre + disc.radius_mm * (at.x() * across + at.y() * along)))
        return true;
    }
  }
  return false;
}

/// The cells of one instant's disc that are free, added to those of the whole exposure.
void add_partly_hidden(FineGrid& sum, const Instant& instant, const Lens& lens, double weight) {
  Vec2 low = instant.rim[0].px, high = low;
  for (const RimPoint& point : instant.rim) {
    low = low.cwiseMin(point.px);
    high = high.cwiseMax(point.px);
  }
  const int x0 = std::max(sum.x0, static_cast<int>(std::floor(low.x())) - 1);
  const int y0 = std::max(sum.y0, static_cast<int>(std::floor(low.y())) - 1);
  const int x1 = std::min(sum.x0 + sum.width, static_cast<int>(std::ceil(high.x())) + 2);
  const int y1 = std::min(sum.y0 + sum.height, static_cast<int>(std::ceil(high.y())) + 2);
  if (x1 <= x0 || y1 <= y0) return;
  FineGrid cells(x0, y0, x1 - x0, y1 - y0, sum.parts);
  add_coverage(cells, polygon_of(instant.rim), weight);
  cut_hidden(cells, instant, lens);
  for (int j = 0; j < cells.rows(); ++j) {
    const double* from = cells.row(j);
    double* to = sum.row(j + (y0 - sum.y0) * sum.parts) + (x0 - sum.x0) * sum.parts;
    for (int i = 0; i < cells.columns(); ++i) to[i] += from[i];
  }
}

/// Mean level over the instants at which the disc shines.
double mean_level(std::span<const Scene> scenes, std::size_t index) {
  double sum = 0;
  int lit = 0;
  for (const Scene& scene : scenes) {
    if (scene.discs[index].brightness <= 0) continue;
    sum += scene.discs[index].level;
    ++lit;
  }
  return lit > 0 ? sum / lit : 0;
}

}  // namespace

DiscLight light_of_disc(std::span<const Scene> scenes, std::size_t index, const Lens& lens,
                        const Sensor& sensor) {
  const double depth_mm = scenes[scenes.size() / 2].discs[index].place.centre.z();
  const double blur_px = spot_sigma_px(sensor, lens, depth_mm);
  const std::vector<Instant> instants = instants_of(scenes, index, lens, blur_px);
  if (instants.empty()) return {};
  FineGrid sum = window_around(instants, lens, blur_px);
  if (sum.width == 0) return {};
  const int parts = parts_for(instants.size());
  std::optional<FineGrid> hidden;  // the instants at which something is in the way: blurred together
  const double weight = 1.0 / static_cast<double>(scenes.size());
  for (const Instant& instant : instants) {
    if (hidden_anywhere(instant, parts)) {
      if (!hidden) hidden.emplace(sum.x0, sum.y0, sum.width, sum.height, parts);
      add_partly_hidden(*hidden, instant, lens, weight);
    } else if (blur_px > 0) {
      add_blurred(sum, instant.rim, blur_px, weight);
    } else {
      add_coverage(sum, polygon_of(instant.rim), weight);
    }
  }
  if (hidden) {
    blur(*hidden, blur_px);
    const std::vector<double> means = pixel_means(*hidden);
    for (std::size_t k = 0; k < means.size(); ++k) sum.values[k] += means[k];
  }
  return {sum.x0, sum.y0, sum.width, sum.height, std::move(sum.values), mean_level(scenes, index)};
}

}  // namespace asterism
