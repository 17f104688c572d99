// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

struct IdentifiabilityOptions {
  int fewest_seen = 4;   // a pose is taken from so many targets or more (3 or more)
  double cap_mm = 10.0;  // larger margins are as good as this one; the search is exact below it
  std::size_t max_steps = 50'000'000;
};

/// How well the best wrong labelling fits: the tracker can take the body for itself elsewhere (or for
/// another body) when its noise comes near this.
struct IdentifiabilityMargin {
  double rms_mm = 0;           // RMS residual of the best proper rigid fit; the cap where none is below it
  std::vector<int> seen;       // the targets seen, ascending, and
  std::vector<int> taken_for;  // what they are taken for; both empty when none is below the cap
  bool complete = true;        // false: `max_steps` was met; a smaller margin may exist
};

/// The smallest RMS at which any `fewest_seen` or more of the targets fit any labels but their own.
/// `seen_together` are the sets of targets that can be seen at once, as bits; any part of one may be what
/// is seen. Empty: all targets can be. At most 64 targets.
///
/// One branch and bound over subsets and labels at once, by Σ|eᵢ|² ≥ Σᵢ<ⱼ (dᵢⱼ − d′ᵢⱼ)²/k. Only `fewest_seen`
/// targets need be tried: were the best fit one of more, then leaving out the target with the largest
/// residual would better it — unless the rest keep their own labels, so that fits of more targets need
/// be tried only where a single one of them is mistaken for a target that is not seen.
[[nodiscard]] IdentifiabilityMargin identifiability_margin(std::span<const Vec3> targets,
                                                           const IdentifiabilityOptions& options = {},
                                                           std::span<const std::uint64_t> seen_together = {});

/// The same for targets of one body taken for those of another; `taken_for` counts the other's targets.
/// It does not matter which of the two is seen.
[[nodiscard]] IdentifiabilityMargin identifiability_between(std::span<const Vec3> targets,
                                                            std::span<const Vec3> of_other_body,
                                                            const IdentifiabilityOptions& options = {});

}  // namespace asterism
