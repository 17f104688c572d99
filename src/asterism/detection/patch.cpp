// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/patch.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/detection/edge_fit.hpp"

namespace asterism {
namespace {

constexpr float kBeyondImage = -1.0F;  // marks `usable` until neighbours are masked
constexpr float kAtCeiling = -2.0F;

float median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

template <class Grey>
GreyScale grey_scale(double step, double brightest) {
  if (sizeof(Grey) == 1) return {255, step};
  for (const int bits : {8, 10, 12, 14}) {
    const double ceiling = step * ((1 << bits) - 1);
    if (brightest <= ceiling) return {ceiling, step};
  }
  return {65535, step};
}

template GreyScale grey_scale<std::uint8_t>(double, double);
template GreyScale grey_scale<std::uint16_t>(double, double);

template <class Grey>
Patch cut_patch(const Raster<Grey>& image, Tone<Grey> tone, const GreyScale& scale, const Ellipse& ellipse,
                double margin) {
  const Mat2 shape = shape_matrix(ellipse);
  const double half_width = std::sqrt(shape(0, 0)) + margin, half_height = std::sqrt(shape(1, 1)) + margin;
  Patch patch;
  patch.x = static_cast<int>(std::floor(ellipse.centre.x() - half_width));
  patch.y = static_cast<int>(std::floor(ellipse.centre.y() - half_height));
  const int width = static_cast<int>(std::ceil(ellipse.centre.x() + half_width)) - patch.x + 1;
  patch.rows = static_cast<int>(std::ceil(ellipse.centre.y() + half_height)) - patch.y + 1;
  patch.stride = (width + 7) / 8 * 8;
  const auto size = static_cast<std::size_t>(patch.stride) * static_cast<std::size_t>(patch.rows);
  patch.grey.assign(size, 0.0F);
  patch.usable.assign(size, kBeyondImage);
  patch.unevenness.assign(size, 0.0F);
  const auto factor = static_cast<float>(1.0 / scale.ceiling);
  const int x_begin = std::max(0, patch.x), x_end = std::min(image.width, patch.x + patch.stride);
  for (int y = std::max(0, patch.y); y < std::min(image.height, patch.y + patch.rows); ++y) {
    const Grey* row = image.row(y);
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y - patch.y) * patch.stride - patch.x;
    for (int x = x_begin; x < x_end; ++x) {
      const float grey = tone(row[x]);
      patch.grey[static_cast<std::size_t>(at + x)] = grey * factor;
      patch.usable[static_cast<std::size_t>(at + x)] =
          grey >= static_cast<float>(scale.ceiling) ? kAtCeiling : 1.0F;
    }
  }
  return patch;
}

template Patch cut_patch(const Raster8&, Tone<std::uint8_t>, const GreyScale&, const Ellipse&, double);
template Patch cut_patch(const Raster16&, Tone<std::uint16_t>, const GreyScale&, const Ellipse&, double);

PatchContent mask_neighbours(Patch& patch, const Ellipse& ellipse) {
  constexpr double kEdgeReach = 2.5;  // px from the edge where its own light ends
  constexpr double kFootReach = 4.0;  // px from the edge where a neighbour's light matters
  constexpr float kNeighbourShare = 0.15F;
  PatchContent content;
  const EdgeModel model = model_of(patch, ellipse);
  PatchModel place;
  evaluate(patch, model, place);
  std::vector<float> inside, outside;
  for (std::size_t i = 0; i < patch.grey.size(); ++i) {
    const float d = place.distance[i];
    if (patch.usable[i] == kBeyondImage) {
      content.border |= d < kEdgeReach;
    } else {
      content.disc_pixels += d < 0;
      content.saturated += d < 0 && patch.usable[i] == kAtCeiling;
      if (d < -std::min(1.0, 0.5 * ellipse.semi_minor)) inside.push_back(patch.grey[i]);
      if (d > kEdgeReach) outside.push_back(patch.grey[i]);
    }
  }
  content.inside = median(inside);
  content.outside = median(outside);
  const auto level = static_cast<float>(content.outside) +
                     kNeighbourShare * static_cast<float>(content.inside - content.outside);
  std::vector<std::size_t> bright;
  for (std::size_t i = 0; i < patch.grey.size(); ++i) {
    if (place.distance[i] > kEdgeReach && patch.grey[i] > level && patch.usable[i] != kBeyondImage)
      bright.push_back(i);
  }
  for (float& usable : patch.usable) usable = std::max(usable, 0.0F);
  for (const std::size_t i : bright) {
    const int column = static_cast<int>(i) % patch.stride, row = static_cast<int>(i) / patch.stride;
    content.neighbour_near |= place.distance[i] < kFootReach;
    for (int y = std::max(0, row - 2); y <= std::min(patch.rows - 1, row + 2); ++y) {
      for (int x = std::max(0, column - 2); x <= std::min(patch.stride - 1, column + 2); ++x) {
        const auto k = static_cast<std::size_t>(y * patch.stride + x);
        // The target's own edge stays in.
        if (place.distance[k] > 0.5) patch.usable[k] = 0;
      }
    }
  }
  return content;
}

}  // namespace asterism
