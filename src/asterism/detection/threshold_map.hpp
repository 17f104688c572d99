// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "asterism/camera/image.hpp"

namespace asterism {

/// Grey levels seen so that discs are bright: the level itself, or for dark discs all ones minus it.
template <class Grey>
struct Tone {
  Grey flip = 0;  // all ones for dark discs
  [[nodiscard]] Grey operator()(Grey grey) const { return static_cast<Grey>(grey ^ flip); }
};

/// Background and threshold on a coarse grid of square tiles; between tile centres bilinear.
struct ThresholdMap {
  static constexpr int kTile = 64;
  int columns = 0, rows = 0;
  std::vector<float> background;  // of each tile
  std::vector<float> noise;       // standard deviation of each tile
  double step = 1;                // the smallest grey step the image uses

  [[nodiscard]] double background_at(double x, double y) const;
};

/// Background = the 40 % quantile of a sample of each tile (so a disc may cover half of it); noise from
/// differences of neighbours, whose largest quarter is left out, so that edges do not count.
template <class Grey>
[[nodiscard]] ThresholdMap threshold_map(const Raster<Grey>& image, Tone<Grey> tone);

/// Each tile's background lowered to the least within `reach` tiles: for discs larger than a tile and for
/// discs beside something bright.
[[nodiscard]] ThresholdMap lowered(const ThresholdMap& map, int reach);

/// The threshold of each pixel of row y, in steps of half a tile: background + max(levels · step, sigmas ·
/// noise). Padded to whole tiles.
template <class Grey>
void thresholds_of_row(const ThresholdMap& map, int y, double levels, double sigmas,
                       std::vector<Grey>& thresholds);

}  // namespace asterism
