// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "asterism/detection/edge_fit.hpp"

namespace asterism {
namespace {

constexpr float kBeyondImage = -1.0F;  // marks `usable` until neighbours are masked
constexpr float kAtCeiling = -2.0F;
constexpr float kEdgeReach = 2.5F;  // px from the edge where its own light ends
constexpr float kFootReach = 4.0F;  // px from the edge where a neighbour's light matters
constexpr double kNeighbourShare = 0.15;

float median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void fill_spans(Patch& patch, const Ellipse& ellipse, double margin) {
  Ellipse grown = ellipse;
  grown.semi_major += margin;
  grown.semi_minor += margin;
  const Mat2 shape = shape_matrix(grown);
  const double width = std::sqrt(shape.determinant() / shape(1, 1));
  patch.spans.resize(static_cast<std::size_t>(patch.rows));
  for (int row = 0; row < patch.rows; ++row) {
    const double dy = row + patch.y - ellipse.centre.y();
    const double half = width * std::sqrt(std::max(0.0, 1 - dy * dy / shape(1, 1)));
    const double middle = ellipse.centre.x() - patch.x + shape(0, 1) / shape(1, 1) * dy;
    const int begin = std::clamp(static_cast<int>(middle - half), 0, patch.stride - 1) / 8 * 8;
    const int end = std::clamp(static_cast<int>(middle + half) + 1, 1, patch.stride);
    patch.spans[static_cast<std::size_t>(row)] = {begin, (end + 7) / 8 * 8};
  }
}

template <class Grey>
GreyScale grey_scale(Tone<Grey> tone, double step, double brightest) {
  if (tone.flip != 0) return {static_cast<double>(tone.flip), step};
  if (sizeof(Grey) == 1) return {255, step};
  for (const int bits : {8, 10, 12, 14}) {
    const double ceiling = step * ((1 << bits) - 1);
    if (brightest <= ceiling) return {ceiling, step};
  }
  return {65535, step};
}

template GreyScale grey_scale(Tone<std::uint8_t>, double, double);
template GreyScale grey_scale(Tone<std::uint16_t>, double, double);

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
  fill_spans(patch, ellipse, margin);
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

template <class Grey>
GreyScale grey_scale(const Raster<Grey>& image, Tone<Grey> tone, const Ellipse& ellipse) {
  const Patch patch = cut_patch(image, tone, {1, 1}, ellipse, 5);
  unsigned first = 0, brightest = 0, darkest = std::numeric_limits<unsigned>::max(), divisor = 0;
  bool any = false;
  for_each_pixel(patch, [&](std::size_t i) {
    if (patch.usable[i] == kBeyondImage) return;
    const auto grey = static_cast<unsigned>(patch.grey[i]);
    if (!any) first = grey;
    any = true;
    brightest = std::max(brightest, grey);
    darkest = std::min(darkest, grey);
    divisor = std::gcd(divisor, grey > first ? grey - first : first - grey);
  });
  // A handful of levels (an ideal image) says nothing of how they are counted.
  if (divisor == 0 || brightest - darkest < 16 * divisor) divisor = 1;
  return grey_scale<Grey>(tone, divisor, brightest);
}

template GreyScale grey_scale(const Raster8&, Tone<std::uint8_t>, const Ellipse&);
template GreyScale grey_scale(const Raster16&, Tone<std::uint16_t>, const Ellipse&);

PatchContent look_at(const Patch& patch, const Ellipse& ellipse) {
  PatchContent content;
  content.distance = distances(patch, model_of(patch, ellipse));
  std::vector<float> inside, outside;
  inside.reserve(patch.grey.size());
  outside.reserve(patch.grey.size());
  const auto well_inside = static_cast<float>(-std::min(1.0, 0.5 * ellipse.semi_minor));
  // Every third pixel of a large disc tells the medians well enough.
  const std::size_t every = ellipse.semi_minor > 4 ? 3 : 1;
  for_each_pixel(patch, [&](std::size_t i) {
    const float d = content.distance[i];
    if (patch.usable[i] == kBeyondImage) {
      content.border |= d < kEdgeReach;
      return;
    }
    content.disc_pixels += d < 0;
    content.saturated += d < 0 && patch.usable[i] == kAtCeiling;
    if (i % every != 0) return;
    if (d < well_inside) inside.push_back(patch.grey[i]);
    if (d > kEdgeReach) outside.push_back(patch.grey[i]);
  });
  content.inside = median(inside);
  content.outside = median(outside);
  return content;
}

void mask_neighbours(Patch& patch, PatchContent& content) {
  const auto level =
      static_cast<float>(content.outside + kNeighbourShare * (content.inside - content.outside));
  std::vector<std::size_t> bright;
  for_each_pixel(patch, [&](std::size_t i) {
    if (content.distance[i] > kEdgeReach && patch.grey[i] > level && patch.usable[i] != kBeyondImage)
      bright.push_back(i);
    patch.usable[i] = std::max(patch.usable[i], 0.0F);
  });
  for (const std::size_t i : bright) {
    const int column = static_cast<int>(i) % patch.stride, row = static_cast<int>(i) / patch.stride;
    content.neighbour_near |= content.distance[i] < kFootReach;
    for (int y = std::max(0, row - 2); y <= std::min(patch.rows - 1, row + 2); ++y) {
      for (int x = std::max(0, column - 2); x <= std::min(patch.stride - 1, column + 2); ++x) {
        const auto k = static_cast<std::size_t>(y * patch.stride + x);
        // The target's own edge stays in.
        if (content.distance[k] > 0.5F) patch.usable[k] = 0;
      }
    }
  }
}

}  // namespace asterism
