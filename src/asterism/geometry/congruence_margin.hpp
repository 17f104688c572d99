// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// A wrong way to lay points on a pattern, and how well it fits.
struct WrongLabelling {
  double rms_mm;           // of the best proper rigid fit; 0 = cannot be told from the right one
  std::vector<int> label;  // which point of the pattern each point is taken for
};

struct WrongLabellingSearch {
  std::optional<WrongLabelling> best;  // empty: none fits better than the cap
  bool complete = true;                // false: `max_steps` was met; a better one may exist
};

/// Of all ways to give `points` (three or more) different labels out of `pattern`, other than `right`,
/// the one whose rigid fit (det = +1) has the smallest RMS below `cap_mm`. `right` may be empty: then
/// every labelling is wrong, as when the pattern is another body's. Branch and bound with
/// Σ|eᵢ|² ≥ Σᵢ<ⱼ (dᵢⱼ − d′ᵢⱼ)² / m for any m points, since residuals of a best fit sum to zero.
[[nodiscard]] WrongLabellingSearch best_wrong_labelling(std::span<const Vec3> points,
                                                        std::span<const Vec3> pattern,
                                                        std::span<const int> right, double cap_mm,
                                                        std::size_t max_steps = 200000);

struct WrongLabellings {
  std::vector<WrongLabelling> found;
  bool complete = true;  // false: `max_steps` was met; more may exist
};

/// All wrong labellings with an RMS below `cap_mm`, in the order of the search.
[[nodiscard]] WrongLabellings wrong_labellings_within(std::span<const Vec3> points,
                                                      std::span<const Vec3> pattern,
                                                      std::span<const int> right, double cap_mm,
                                                      std::size_t max_steps = 20000);

}  // namespace asterism
