// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asterism/geometry/ray_scene.hpp"
#include "asterism/scanning/viewpoints.hpp"

// What the paper's scanner (Table 8) would measure from its stations of a part like the paper's: the cone
// that its stations run along (LEDGER 2.6), bare, or with flanges and bosses.

namespace asterism {

/// A part to be scanned, in the frame of the stations.
struct ScannedPart {
  std::string name;
  RayScene surface;
  std::vector<SurfaceSample> samples;
  std::vector<std::uint8_t> outer;  // by sample: it belongs to the outer wall and what stands out from it
};
/// From 115 mm below the frame to 485 mm above, 12 mm thick, open at both ends: as far as the rings of both
/// tables reach, whose stations look at places 36 mm higher than themselves.
[[nodiscard]] ScannedPart bare_cone();
/// The casing of the built-in cell: 560 mm, flanges below and above, twelve bosses.
[[nodiscard]] ScannedPart flanged_casing();

/// Which samples are measured from any of the stations.
[[nodiscard]] std::vector<std::uint8_t> measured_from(const ScannedPart& part,
                                                      std::span<const Viewpoint> stations);
/// Either.
[[nodiscard]] std::vector<std::uint8_t> either(std::vector<std::uint8_t> a,
                                               const std::vector<std::uint8_t>& b);

/// Share of the area; of the outer wall alone, or of the whole part.
[[nodiscard]] double share_of_outer(const ScannedPart& part, std::span<const std::uint8_t> measured);
[[nodiscard]] double share_of_whole(const ScannedPart& part, std::span<const std::uint8_t> measured);

/// The fewest of 2,000 views that were found for 99 % of what they measure of the outer wall, how few no
/// choice of them goes below, and that share of the outer wall's area.
struct FewestViews {
  std::size_t views = 0, bound = 0;
  double share = 0;
};
[[nodiscard]] FewestViews fewest_views_of_outer_wall(const ScannedPart& part);

}  // namespace asterism
