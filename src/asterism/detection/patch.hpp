// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/camera/image.hpp"
#include "asterism/detection/edge_kernel.hpp"
#include "asterism/detection/threshold_map.hpp"
#include "asterism/geometry/ellipse.hpp"

namespace asterism {

/// The grey levels of an image as numbers from 0 to 1.
struct GreyScale {
  double ceiling = 255;  // grey level of a saturated pixel
  double step = 1;       // the smallest grey step in use
};

/// The ceiling of 16-bit images is taken as 10, 12, 14 or 16 bits of `step`, whatever just holds `brightest`;
/// for dark discs it is black.
template <class Grey>
[[nodiscard]] GreyScale grey_scale(Tone<Grey> tone, double step, double brightest);

/// From the pixels around one target alone.
template <class Grey>
[[nodiscard]] GreyScale grey_scale(const Raster<Grey>& image, Tone<Grey> tone, const Ellipse& ellipse);

/// Cuts out the ellipse and about `margin` px around it. Pixels beyond the image or at the ceiling are not
/// usable.
template <class Grey>
[[nodiscard]] Patch cut_patch(const Raster<Grey>& image, Tone<Grey> tone, const GreyScale& scale,
                              const Ellipse& ellipse, double margin);

/// Sets the spans: of each row what lies within the ellipse grown by the margin, in groups of eight columns.
void fill_spans(Patch& patch, const Ellipse& ellipse, double margin);

/// What lies in a patch besides its target.
struct PatchContent {
  double inside = 0, outside = 0;  // median grey level well inside and just outside of the ellipse
  int saturated = 0;               // pixels of the disc at the ceiling
  int disc_pixels = 0;             // pixels of the disc in the image
  bool neighbour_near = false;     // a neighbour's light reaches the edge's foot
  std::vector<float> distance;     // of each pixel to the ellipse, px
  bool border = false;             // part of the edge's reach lies beyond the image
};

[[nodiscard]] PatchContent look_at(const Patch& patch, const Ellipse& ellipse);

/// Makes pixels of neighbours unusable: what is brighter than the background by a part of the amplitude yet
/// clear of the ellipse, and two pixels around that.
void mask_neighbours(Patch& patch, PatchContent& content);

/// Calls `body(i)` for the index of each pixel within the spans.
template <class Body>
void for_each_pixel(const Patch& patch, Body&& body) {
  for (int row = 0; row < patch.rows; ++row) {
    const auto [begin, end] = patch.spans[static_cast<std::size_t>(row)];
    const auto at = static_cast<std::size_t>(row * patch.stride);
    for (auto i = at + static_cast<std::size_t>(begin); i < at + static_cast<std::size_t>(end); ++i) body(i);
  }
}

}  // namespace asterism
