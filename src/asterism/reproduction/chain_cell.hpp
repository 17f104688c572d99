// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/reproduction/papers_cell.hpp"

namespace asterism {

/// Angle between a target's normal and a sight line up to which a camera counts as seeing it: at this one
/// both cameras see four to eight of Figure 20's targets.
constexpr double kChainAcceptanceDeg = 65;

/// The cell of papers_cell.hpp as the whole program knows it, so that its own rooms can be set to work on it:
/// the two cameras, a platform at rest but for 5 to 9 s (watch_ring's motion, a key each 20 ms), the conical
/// casing of Table 15 around the targets, the scanner at its first station. Discs of 8 mm.
[[nodiscard]] Cell chain_cell(const std::vector<Target>& targets, const TrackerPlace& place = {});

/// Targets that face up: the paper tells no normals of its schemes. Both cameras then see all of them through
/// the whole motion.
[[nodiscard]] std::vector<Target> chain_targets(std::span<const Vec3> places);
/// The eight targets of Figure 20.
[[nodiscard]] std::vector<Target> chain_ring(const RingOfTargets& ring = {});

}  // namespace asterism
