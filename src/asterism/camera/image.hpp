// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace asterism {

/// A grey image owned as one block, rows without gaps. Pixel (0, 0) is the centre of the top-left pixel.
template <class Grey>
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<Grey> pixels;

  Raster() = default;
  Raster(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  [[nodiscard]] const Grey* row(int y) const {
    return pixels.data() + static_cast<std::ptrdiff_t>(y) * width;
  }
  [[nodiscard]] Grey* row(int y) { return pixels.data() + static_cast<std::ptrdiff_t>(y) * width; }
  [[nodiscard]] Grey at(int x, int y) const { return row(y)[x]; }
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

using Raster8 = Raster<std::uint8_t>;
using Raster16 = Raster<std::uint16_t>;
using Image = std::variant<Raster8, Raster16>;

[[nodiscard]] inline int width_of(const Image& image) {
  return std::visit([](const auto& raster) { return raster.width; }, image);
}
[[nodiscard]] inline int height_of(const Image& image) {
  return std::visit([](const auto& raster) { return raster.height; }, image);
}

}  // namespace asterism
