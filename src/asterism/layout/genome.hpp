// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asterism/layout/surface.hpp"
#include "asterism/optimization/problem.hpp"
#include "asterism/optimization/variation.hpp"

namespace asterism {

// A layout as an optimiser's genes: x, y, z (mm, in the body's frame) of each target, so that their count
// varies; and how layouts breed.

/// Throws ContractViolation when the count is no multiple of three.
[[nodiscard]] std::vector<Vec3> positions_of(std::span<const double> genes);
[[nodiscard]] Genes genes_of(std::span<const Vec3> positions);

/// What every layout must keep to.
struct LayoutRules {
  DeployableSurface surface;
  double clearance_mm = 0;  // from keep-outs to a target's centre
  double spacing_mm = 100;  // between two targets' centres
  int fewest = 4;
  int most = 12;
};

/// The same layout in one order (by x, y, z): layouts that differ by their targets' order alone are one.
void put_in_order(std::vector<Vec3>& layout);

/// Brings a layout to the surface, into `fewest` … `most` targets, and apart: targets too near to one another
/// are pushed along the surface, then moved to a free place at random, then left out while more than
/// `fewest` remain. What still stands too near is left for a constraint to judge. In order at the end.
void repair(std::vector<Vec3>& layout, const LayoutRules& rules, RandomStream& random);

/// So many targets at random, pushed along the surface until they keep their distance. Empty when that does
/// not come off in 300 sweeps.
[[nodiscard]] std::optional<std::vector<Vec3>> spread_apart(int targets, const LayoutRules& rules,
                                                            RandomStream& random);

/// A random plane through the parents' middle: each child has one parent's targets on one side and the
/// other's on the other (as Ryerkerk et al. 2017 have it for lists of any length).
void cut_and_join(std::span<const Vec3> mother, std::span<const Vec3> father, std::vector<Vec3>& daughter,
                  std::vector<Vec3>& son, RandomStream& random);

/// Parents' targets in pairs, nearest first; each pair's coordinates cross as `variation` does. Targets
/// without a partner stay with the child of their parent.
void cross_matched(std::span<const Vec3> mother, std::span<const Vec3> father, const Bounds& bounds,
                   const Variation& variation, std::vector<Vec3>& daughter, std::vector<Vec3>& son,
                   RandomStream& random);

/// How often a child changes in each way; probabilities.
struct LayoutMutation {
  double add = 0.08;       // a target at a random place
  double remove = 0.08;    // one of the targets
  double relocate = 0.12;  // one of them to a random place
  double nudge = 0.5;      // one of them by 0.1 to 10 % of the surface's size, all scales alike
};
void mutate(std::vector<Vec3>& layout, const LayoutRules& rules, const Bounds& bounds,
            const Variation& variation, const LayoutMutation& mutation, RandomStream& random);

/// The least sum of distances by which the targets of one layout become another's: an assignment (Kuhn
/// 1955), where a target taken away or added counts `handling_mm`.
[[nodiscard]] double moving_cost_mm(std::span<const Vec3> from, std::span<const Vec3> to, double handling_mm);

}  // namespace asterism
