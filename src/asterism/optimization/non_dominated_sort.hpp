// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "asterism/optimization/dominance_tree.hpp"
#include "asterism/optimization/lexicographic_order.hpp"
#include "asterism/optimization/staircase.hpp"

namespace asterism {

/// Points by rank: those of front k are order[begin[k]] … order[begin[k + 1] − 1], in lexicographic order of
/// their objectives. Front 0 is dominated by nobody, front k by someone of front k − 1 at least.
struct Fronts {
  std::vector<int> rank;             // per point
  std::vector<std::uint32_t> order;  // all points, front after front
  std::vector<std::uint32_t> begin;  // one more than there are fronts

  [[nodiscard]] std::size_t count() const { return begin.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> front(std::size_t k) const {
    return std::span(order).subspan(begin[k], begin[k + 1] - begin[k]);
  }
};

/// Sorts points into fronts of mutually non-dominated ones; all objectives are minimised. Equal points share
/// a rank, and what is compared is compared exactly. Its memory is reused from call to call.
class NonDominatedSort {
 public:
  /// `objectives` is count × m, row-major, none NaN. The result is valid until the next call.
  const Fronts& operator()(std::span<const double> objectives, std::size_t m);
  /// The last result again.
  [[nodiscard]] const Fronts& fronts() const { return fronts_; }

 private:
  void sweep_one(std::span<const double> objectives);
  void sweep_two(std::span<const double> objectives);
  template <class Front>
  void sweep_fronts(std::span<const double> objectives, std::size_t m, std::vector<Front>& fronts);
  void gather_fronts(std::size_t fronts);

  LexicographicOrder lexicographic_order_;
  std::span<const std::uint32_t> order_;
  std::vector<std::uint32_t> ranks_;  // in that order
  std::vector<double> tails_;
  std::vector<Staircase> staircases_;  // a front each
  std::vector<DominanceTree> trees_;
  std::vector<std::uint32_t> ends_;
  Fronts fronts_;
};

/// Rank of each point: 0 for the first front.
[[nodiscard]] std::vector<int> non_dominated_ranks(std::span<const double> objectives, std::size_t m);

}  // namespace asterism
