// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/scanning/completeness.hpp"

namespace asterism {

/// The places that are not measured, put together to holes, largest first. Two places hang together when one
/// is among the eight nearest of the other that face the same way (within `max_turn_deg`), measured or not:
/// so the sides of a thin wall do not, nor holes with a measured strip between them, however dense the
/// samples are. Places of weight 0 are left out.
[[nodiscard]] std::vector<Hole> holes_of(std::span<const SurfaceSample> samples,
                                         std::span<const std::uint8_t> measured, double max_turn_deg);

}  // namespace asterism
