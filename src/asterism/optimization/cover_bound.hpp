// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/optimization/cover_model.hpp"

namespace asterism {

/// A price u ≥ 0 for each missing cover, and what no cover can cost less than by it.
struct CoverPrices {
  std::vector<double> price;  // by row
  double bound = 0;           // not rounded
};

/// The Lagrangian dual: with demands d, weights w and costs c, f of columns and groups, for any u ≥ 0
///
///   min { Σ dᵢuᵢyᵢ : Σ wᵢyᵢ ≥ target, 0 ≤ y ≤ 1 } + Σ_g min(0, f_g + Σ_{j in g} min(0, cⱼ − Σ_{i in j} uᵢ))
///
/// is at most the least cost; u climbs by subgradients (Held & Karp 1971) towards `upper`, a
/// known cover's cost. It ends near the linear relaxation's bound, in a small
/// part of its time.
[[nodiscard]] CoverPrices dual_bound(const CoverModel& model, double upper, int steps = 1500);

}  // namespace asterism
