// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/triangle_raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "asterism/core/result.hpp"
#include "asterism/simulation/lanes.hpp"

namespace asterism {
namespace {

constexpr int kSamples = 4;
constexpr std::int32_t kNothing = -1;
static_assert(kSamples == kDoubleLanes);
constexpr double kNearest_mm = 1;
constexpr double kLeastArea_px2 = 1e-7;

struct Corner {
  Vec3 in_camera;  // mm
  Vec2 px;
  bool in_front;
};

Corner corner_of(const Vec3& in_camera, const Lens& lens) {
  if (!(in_camera.z() > kNearest_mm)) return {in_camera, Vec2::Zero(), false};
  const Vec2 xy = in_camera.hnormalized();
  return {in_camera, pixel_from_normalised(lens, lens.coefficients == 0 ? xy : distort(lens, xy).xy), true};
}

/// Of a quantity that is linear in the image: its value at corner 0 and its slopes.
ScreenTriangle::Slopes slopes(const std::array<Vec3, 3>& at, const Mat2& by_px) {
  const Vec3 along = at[1] - at[0], across = at[2] - at[0];
  ScreenTriangle::Slopes found;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    found.at[i] = static_cast<float>(at[0](axis));
    found.by_x[i] = static_cast<float>(along(axis) * by_px(0, 0) + across(axis) * by_px(1, 0));
    found.by_y[i] = static_cast<float>(along(axis) * by_px(0, 1) + across(axis) * by_px(1, 1));
  }
  return found;
}

/// Of a triangle that is run around clockwise as seen (y goes down).
ScreenTriangle::Side side_of(const Vec2& from, const Vec2& to) {
  if (from.y() == to.y()) return {0, 0, 0};
  // The same bits whichever way it is run along: neighbours meet without gap or overlap.
  const Vec2& upper = from.y() < to.y() ? from : to;
  const Vec2& lower = from.y() < to.y() ? to : from;
  const double by_y = (lower.x() - upper.x()) / (lower.y() - upper.y());
  return {upper.x() - by_y * upper.y(), by_y, from.y() < to.y() ? -1 : 1};
}

std::optional<ScreenTriangle> screen_triangle(const std::array<const Corner*, 3>& corners,
                                              std::array<Vec3, 3> normals) {
  const Vec2& a = corners[0]->px;
  const Vec2 along = corners[1]->px - a, across = corners[2]->px - a;
  const double twice_area = along.x() * across.y() - along.y() * across.x();
  if (!(std::abs(twice_area) > kLeastArea_px2)) return std::nullopt;
  Mat2 by_px;  // of the weights of corners 1 and 2
  by_px << across.y(), -across.x(), -along.y(), along.x();
  by_px /= twice_area;
  ScreenTriangle triangle;
  triangle.x0 = static_cast<float>(a.x());
  triangle.y0 = static_cast<float>(a.y());
  std::array<Vec3, 3> inverse_depth, sight;
  for (std::size_t k = 0; k < 3; ++k) {
    const double depth = corners[k]->in_camera.z();
    inverse_depth[k] = Vec3(1 / depth, 0, 0);
    sight[k] = corners[k]->in_camera / depth;
    normals[k] *= 1000 / depth;
    triangle.depth_mm += static_cast<float>(depth / 3);
    const Vec2& from = corners[k]->px;
    const Vec2& to = corners[(k + 1) % 3]->px;
    triangle.sides[k] = twice_area > 0 ? side_of(from, to) : side_of(to, from);
  }
  const ScreenTriangle::Slopes depth = slopes(inverse_depth, by_px);
  triangle.inverse_depth = depth.at[0];
  triangle.inverse_depth_by_x = depth.by_x[0];
  triangle.inverse_depth_by_y = depth.by_y[0];
  triangle.normal = slopes(normals, by_px);
  triangle.sight = slopes(sight, by_px);
  const auto [left, right] = std::minmax({a.x(), corners[1]->px.x(), corners[2]->px.x()});
  const auto [top, bottom] = std::minmax({a.y(), corners[1]->px.y(), corners[2]->px.y()});
  triangle.left = left;
  triangle.right = right;
  triangle.top = top;
  triangle.bottom = bottom;
  return triangle;
}

/// Where a sample lies within its pixel.
Vec2 offset_of(int sample, int samples) {
  static const std::array<Vec2, kSamples> kSpread = {Vec2(-0.125, -0.375), Vec2(0.375, -0.125),
                                                     Vec2(0.125, 0.375), Vec2(-0.375, 0.125)};
  return samples == 1 ? Vec2(0, 0) : kSpread[static_cast<std::size_t>(sample)];
}

struct SampleRow {
  float* inverse_depth;
  std::int32_t* number;
};

/// Keeps the nearer of what is there and a triangle whose inverse depth runs along the row. Rows are followed
/// by others or by room for one lane.
ASTERISM_INLINE void draw_row(const SampleRow& row, int first, int end, float at_zero, float by_x,
                              std::int32_t number) {
  const FloatLanes kSteps = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int x = first; x < end; x += kFloatLanes) {
    FloatLanes nearest;
    IntLanes owner;
    std::memcpy(&nearest, row.inverse_depth + x, sizeof nearest);
    std::memcpy(&owner, row.number + x, sizeof owner);
    const FloatLanes here = at_zero + by_x * (static_cast<float>(x) + kSteps);
    const IntLanes nearer = (here > nearest) & (kSteps < static_cast<float>(end - x));
    nearest = nearer ? here : nearest;
    owner = nearer ? number - IntLanes{} : owner;
    std::memcpy(row.inverse_depth + x, &nearest, sizeof nearest);
    std::memcpy(row.number + x, &owner, sizeof owner);
  }
}

ASTERISM_INLINE DoubleLanes larger(const DoubleLanes& a, const DoubleLanes& b) { return a > b ? a : b; }
ASTERISM_INLINE DoubleLanes smaller(const DoubleLanes& a, const DoubleLanes& b) { return a < b ? a : b; }

/// The first whole numbers that are not less, from 0 to `size`.
ASTERISM_INLINE std::array<int, kDoubleLanes> first_from(const DoubleLanes& place, double size) {
  const DoubleLanes within = smaller(larger(place, DoubleLanes{}), size - DoubleLanes{});
  std::array<int, kDoubleLanes> first{};
#pragma GCC unroll 4
  for (std::size_t k = 0; k < kDoubleLanes; ++k) {
    const int whole = static_cast<int>(within[k]);
    first[k] = whole + static_cast<int>(whole < within[k]);
  }
  return first;
}

/// What lies between the sides of a triangle.
struct Between {
  std::array<ScreenTriangle::Side, 2> left{}, right{};  // two of each: one may stand twice

  explicit Between(const ScreenTriangle& triangle) {
    std::size_t lefts = 0, rights = 0;
    for (const ScreenTriangle::Side& side : triangle.sides) {
      if (side.from > 0) left[lefts++] = side;
      if (side.from < 0) right[rights++] = side;
    }
    if (lefts == 1) left[1] = left[0];
    if (rights == 1) right[1] = right[0];
  }
  [[nodiscard]] ASTERISM_INLINE DoubleLanes begin(const DoubleLanes& y) const {
    return larger(left[0].at_zero + left[0].by_y * y, left[1].at_zero + left[1].by_y * y);
  }
  [[nodiscard]] ASTERISM_INLINE DoubleLanes end(const DoubleLanes& y) const {
    return smaller(right[0].at_zero + right[0].by_y * y, right[1].at_zero + right[1].by_y * y);
  }
  /// Never comes between two columns while it goes from one height to another: sides are straight.
  [[nodiscard]] bool misses(double top, double bottom, double from_x, double to_x) const {
    const auto at = [](const ScreenTriangle::Side& side, double y) { return side.at_zero + side.by_y * y; };
    for (std::size_t k = 0; k < 2; ++k) {
      if (std::min(at(left[k], top), at(left[k], bottom)) > to_x) return true;
      if (std::max(at(right[k], top), at(right[k], bottom)) < from_x) return true;
    }
    return false;
  }
};

/// A tile's grids of samples, of which four rows are drawn at once: those of one row of pixels, or with one
/// sample a pixel four rows of them.
struct SampleGrid {
  SampleRow first;
  int x0, y0, size, samples;
};

ASTERISM_CLONES void draw_samples(const SampleGrid& grid, const ScreenTriangle& triangle,
                                  std::int32_t number) {
  const bool one = grid.samples == 1;
  const int first_y = static_cast<int>(std::clamp<double>(triangle.top - grid.y0 - 1, 0, grid.size));
  const int end_y = static_cast<int>(std::clamp<double>(triangle.bottom - grid.y0 + 2, 0, grid.size));
  const Between between(triangle);
  if (first_y >= end_y ||
      between.misses(grid.y0 + first_y - 1, grid.y0 + end_y + 1, grid.x0 - 1, grid.x0 + grid.size))
    return;
  const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(grid.size) * grid.size;
  DoubleLanes shift_x{}, shift_y{};
  for (int k = 0; k < kSamples; ++k) {
    shift_x[k] = grid.x0 + (one ? 0.0 : offset_of(k, kSamples).x());
    shift_y[k] = grid.y0 + (one ? k : offset_of(k, kSamples).y());
  }
  for (int y = first_y; y < end_y; y += one ? kSamples : 1) {
    const DoubleLanes height = y + shift_y;
    const auto begin = first_from(between.begin(height) - shift_x, grid.size);
    const auto end = first_from(between.end(height) - shift_x, grid.size);
    for (std::size_t k = 0; k < kSamples; ++k) {
      const int row = one ? y + static_cast<int>(k) : y;
      if (begin[k] >= end[k] || height[k] < triangle.top || height[k] >= triangle.bottom || row >= grid.size)
        continue;
      const std::ptrdiff_t at =
          row * static_cast<std::ptrdiff_t>(grid.size) + (one ? 0 : static_cast<std::ptrdiff_t>(k) * plane);
      const float at_zero = triangle.inverse_depth +
                            triangle.inverse_depth_by_x * (static_cast<float>(shift_x[k]) - triangle.x0) +
                            triangle.inverse_depth_by_y * (static_cast<float>(height[k]) - triangle.y0);
      draw_row({grid.first.inverse_depth + at, grid.first.number + at}, begin[k], end[k], at_zero,
               triangle.inverse_depth_by_x, number);
    }
  }
}

/// Light that comes back from places of the triangle, `x` and `y` told from its first corner.
ASTERISM_INLINE FloatLanes light_of(const ScreenTriangle& triangle, const FloatLanes& x, float y,
                                    float specular) {
  FloatLanes dot = {}, normal2 = {}, sight2 = {};
#pragma GCC unroll 3
  for (std::size_t k = 0; k < 3; ++k) {
    const FloatLanes n = (triangle.normal.at[k] + triangle.normal.by_y[k] * y) + triangle.normal.by_x[k] * x;
    const FloatLanes s = (triangle.sight.at[k] + triangle.sight.by_y[k] * y) + triangle.sight.by_x[k] * x;
    dot += n * s;
    normal2 += n * n;
    sight2 += s * s;
  }
  dot = dot < 0 ? -dot : dot;
  const FloatLanes cosine = dot * inverse_root(normal2 * sight2);
  if (specular == 0) return triangle.level * cosine;
  FloatLanes mirrored = cosine;
#pragma GCC unroll 8
  for (int doubling = 0; doubling < 8; ++doubling) mirrored *= mirrored;
  return triangle.level * cosine + specular * mirrored;
}

ASTERISM_INLINE void add_to(float* to, const FloatLanes& more) {
  FloatLanes sum;
  std::memcpy(&sum, to, sizeof sum);
  sum += more;
  std::memcpy(to, &sum, sizeof sum);
}

/// Adds the light of `count` pixels side by side, the first at `px`.
ASTERISM_CLONES void add_run(const ScreenTriangle& triangle, const Vec2& px, int count, float specular,
                             float weight, float* light, float* share) {
  const FloatLanes kSteps = {0, 1, 2, 3, 4, 5, 6, 7};
  const auto first = static_cast<float>(px.x()) - triangle.x0;
  const auto y = static_cast<float>(px.y()) - triangle.y0;
  for (int i = 0; i < count; i += kFloatLanes) {
    const FloatLanes found = light_of(triangle, first + static_cast<float>(i) + kSteps, y, specular);
    if (i + kFloatLanes <= count) {
      add_to(light + i, weight * found);
      add_to(share + i, weight - FloatLanes{});
      continue;
    }
    for (int k = 0; i + k < count; ++k) {
      light[i + k] += weight * found[k];
      share[i + k] += weight;
    }
  }
}

}  // namespace

void add_screen_triangles(const DrawnSurface& surface, const RigidMotion& camera_from_carrier,
                          const Lens& lens, std::vector<ScreenTriangle>& triangles) {
  const Mat3 turn = camera_from_carrier.rotation.toRotationMatrix();
  std::vector<Corner> corners;
  corners.reserve(surface.places.size());
  for (const Vec3& place : surface.places) {
    corners.push_back(corner_of(turn * place + camera_from_carrier.translation, lens));
  }
  for (const DrawnSurface::Triangle& one : surface.triangles) {
    const std::array<const Corner*, 3> at = {&corners[one.corner[0]], &corners[one.corner[1]],
                                             &corners[one.corner[2]]};
    if (!at[0]->in_front || !at[1]->in_front || !at[2]->in_front) continue;
    const Vec3 outwards = (at[1]->in_camera - at[0]->in_camera).cross(at[2]->in_camera - at[0]->in_camera);
    if (surface.closed && outwards.dot(at[0]->in_camera) >= 0) continue;
    auto triangle = screen_triangle(at, {turn * one.normal[0], turn * one.normal[1], turn * one.normal[2]});
    if (!triangle) continue;
    triangle->level = static_cast<float>(surface.level);
    triangles.push_back(*triangle);
  }
}

SampledTile::SampledTile(int x0, int y0, int size, int samples)
    : x0_(x0),
      y0_(y0),
      size_(size),
      samples_(samples),
      inverse_depth_(row_of(samples, 0) + kFloatLanes, 0.0F),
      number_(row_of(samples, 0) + kFloatLanes, kNothing) {
  require(samples == 1 || samples == kSamples, "a pixel has one sample or four");
}

void SampledTile::draw(const ScreenTriangle& triangle, std::int32_t number) {
  draw_samples({{inverse_depth_.data(), number_.data()}, x0_, y0_, size_, samples_}, triangle, number);
}

void SampledTile::add_light(std::span<const ScreenTriangle> triangles, float specular, float weight,
                            std::vector<float>& light, std::vector<float>& share) const {
  const auto each = weight / static_cast<float>(samples_);
  for (int y = 0; y < size_; ++y) {
    float* to = light.data() + row_of(0, y);
    float* covered = share.data() + row_of(0, y);
    const auto at = [&](int sample, int x) {
      return number_[row_of(sample, y) + static_cast<std::size_t>(x)];
    };
    const auto whole = [&](int x) {
      return samples_ == 1 || (at(0, x) == at(1, x) && at(0, x) == at(2, x) && at(0, x) == at(3, x));
    };
    for (int x = 0; x < size_;) {
      if (!whole(x)) {
        for (int sample = 0; sample < samples_;) {  // neighbours of one owner are lit alike
          const std::int32_t owner = at(sample, x);
          int next = sample + 1;
          while (next < samples_ && at(next, x) == owner) ++next;
          if (owner != kNothing) {
            add_run(triangles[static_cast<std::size_t>(owner)],
                    Vec2(x0_ + x, y0_ + y) + offset_of(sample, samples_), 1, specular,
                    each * static_cast<float>(next - sample), to + x, covered + x);
          }
          sample = next;
        }
        ++x;
        continue;
      }
      int end = x + 1;
      while (end < size_ && at(0, end) == at(0, x) && whole(end)) ++end;
      if (at(0, x) != kNothing) {
        add_run(triangles[static_cast<std::size_t>(at(0, x))], {x0_ + x, y0_ + y}, end - x, specular, weight,
                to + x, covered + x);
      }
      x = end;
    }
  }
}

}  // namespace asterism
