// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asterism/camera/lens.hpp"
#include "asterism/geometry/rigid_motion.hpp"
#include "asterism/simulation/surface.hpp"

namespace asterism {

/// A triangle in an image (px). What varies over it does so linearly in the image: one over its depth, and
/// with that normals and sight lines, each told by its value at the first corner and its two slopes.
struct ScreenTriangle {
  struct Slopes {
    std::array<float, 3> at{}, by_x{}, by_y{};
  };
  struct Side {
    double at_zero, by_y;  // x of the side at height y
    int from = 0;          // +1: the inside is to its right, −1: to its left, 0: level
  };
  float x0 = 0, y0 = 0;  // first corner
  float inverse_depth = 0, inverse_depth_by_x = 0, inverse_depth_by_y = 0;
  Slopes normal, sight;
  std::array<Side, 3> sides{};
  double left = 0, right = 0, top = 0, bottom = 0;
  float depth_mm = 0;  // mean of its corners
  float level = 0;
};

/// The triangles of a surface that face the camera (all, when it is not closed), through the lens. One that
/// reaches behind the camera is left out.
void add_screen_triangles(const DrawnSurface& surface, const RigidMotion& camera_from_carrier,
                          const Lens& lens, std::vector<ScreenTriangle>& triangles);

/// A square of an image with up to four samples a pixel; four, spread as on a rotated grid, put an edge to an
/// eighth of a pixel. Each sample keeps the nearest triangle that covers it.
class SampledTile {
 public:
  SampledTile(int x0, int y0, int size, int samples);
  void draw(const ScreenTriangle& triangle, std::int32_t number);

  /// Adds to each pixel `weight` times the light of what covers it, and the share that is covered: the
  /// camera's own lamp by Lambert's law, level · cos(incidence), and what the surface mirrors back of it,
  /// specular · cos²⁵⁶: half as much at 4°. Both `size` × `size`.
  void add_light(std::span<const ScreenTriangle> triangles, float specular, float weight,
                 std::vector<float>& light, std::vector<float>& share) const;

 private:
  [[nodiscard]] std::size_t row_of(int sample, int y) const {
    return (static_cast<std::size_t>(sample) * static_cast<std::size_t>(size_) +
            static_cast<std::size_t>(y)) *
           static_cast<std::size_t>(size_);
  }
  int x0_, y0_, size_, samples_;
  std::vector<float> inverse_depth_;  // by sample, row, column; 0 = nothing there
  std::vector<std::int32_t> number_;
};

}  // namespace asterism
