// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/optimization/cover_bound.hpp"
#include "asterism/optimization/cover_model.hpp"

namespace asterism {

/// What the exact search found.
struct ExactCover {
  std::vector<std::uint32_t> chosen;  // the start where nothing cheaper was found
  double bound = 0;                   // no cover costs less; not rounded
  std::string words;                  // how it ended
};

/// Branch and cut (CBC) over the integer program with x, y, z in {0, 1}
///
///   min Σ cⱼxⱼ + Σ f_g z_g    Σ_{j covers i} xⱼ ≥ dᵢyᵢ    Σ wᵢyᵢ ≥ target    xⱼ ≤ z_g(j)
///
/// for what costs less than `start`; first its linear relaxation, whose reduced costs take out columns that
/// no cheaper cover can have. `bound` is a bound known before. With `exact_deterministic` it ends by counts
/// of simplex iterations and nodes fit for `exact_s`, and by the clock only after three times that and a
/// second.
[[nodiscard]] ExactCover exact_cover(const CoverModel& model, std::span<const std::uint32_t> start,
                                     const CoverPrices& prices, const SetCoverOptions& options,
                                     const Progress& progress);

}  // namespace asterism
