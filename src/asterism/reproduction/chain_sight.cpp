// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/chain_sight.hpp"

#include "asterism/visibility/availability.hpp"
#include "asterism/visibility/watch.hpp"

namespace asterism {

std::vector<SightOfRing> watch_chain(const TrackerPlace& place, const RingOfTargets& ring) {
  const Cell cell = chain_cell(chain_ring(ring), place);
  std::vector<SightOfRing> sights = watch_ring(place, ring);
  std::vector<double> times_s;
  for (const SightOfRing& sight : sights) times_s.push_back(sight.time_s);
  VisibilityOptions options;
  options.max_incidence_deg = deg_from_rad(ring.acceptance_rad);
  const WatchedCell watched = watch_cell(cell, times_s, options, Occlusion(cell));
  const std::vector<int> visible = visible_counts(watched.bodies.front().visibility);
  for (std::size_t i = 0; i < sights.size(); ++i) {
    sights[i].visible = visible[i];
    sights[i].coverage = watched.coverage[i];
  }
  return sights;
}

}  // namespace asterism
