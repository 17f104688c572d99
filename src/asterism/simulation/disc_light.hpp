// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "asterism/simulation/coverage.hpp"
#include "asterism/simulation/scene.hpp"

namespace asterism {

/// How much of each pixel's light comes from one disc: coverage averaged over the exposure's instants,
/// hidden parts left out, blurred by the lens as its depth asks.
struct DiscLight {
  int x0 = 0, y0 = 0, width = 0, height = 0;
  std::vector<double> shares;  // rows of `width`; empty when the disc is not in the image
  double level = 0;            // mean over the instants at which it shines
};

/// `scenes` are the instants of the exposure, each with the same discs in the same order.
[[nodiscard]] DiscLight light_of_disc(std::span<const Scene> scenes, std::size_t index, const Lens& lens,
                                      const Sensor& sensor);

}  // namespace asterism
