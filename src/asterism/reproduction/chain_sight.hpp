// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/chain_cell.hpp"

namespace asterism {

/// Figure 20 by the program's own rooms: a target counts when both cameras have it in their images, turned to
/// them by no more than the acceptance, apart from its neighbours, with the casing out of the way. Each
/// camera stands half a metre beside the middle, so both together ask for about 5° more of acceptance than
/// the one eye of watch_ring().
[[nodiscard]] std::vector<SightOfRing> watch_chain(const TrackerPlace& place, const RingOfTargets& ring);

constexpr double kChainAcceptanceRad = rad_from_deg(kChainAcceptanceDeg);

}  // namespace asterism
