// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/non_dominated_sort.hpp"

#include <algorithm>

namespace asterism {
namespace {

/// First of the ascending `values` that is greater than `x`, without branches that could be mispredicted.
std::size_t first_greater(std::span<const double> values, double x) {
  const double* base = values.data();
  std::size_t length = values.size();
  if (length == 0) return 0;
  while (length > 1) {
    const std::size_t half = length / 2;
    base += half & -static_cast<std::size_t>(base[half - 1] <= x);  // all bits or none
    length -= half;
  }
  return static_cast<std::size_t>(base - values.data()) + (*base <= x ? 1 : 0);
}

}  // namespace

const Fronts& NonDominatedSort::operator()(std::span<const double> objectives, std::size_t m) {
  order_ = lexicographic_order_(objectives, m);
  ranks_.resize(order_.size());
  if (m == 1)
    sweep_one(objectives);
  else if (m == 2)
    sweep_two(objectives);
  else if (m == 3)
    sweep_three(objectives);
  else
    sweep_many(objectives, m);
  return fronts_;
}

void NonDominatedSort::sweep_one(std::span<const double> objectives) {
  int rank = 0;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    if (i > 0 && objectives[order_[i]] != objectives[order_[i - 1]]) ++rank;
    ranks_[i] = static_cast<std::uint32_t>(rank);
  }
  gather_fronts(order_.empty() ? 0 : static_cast<std::size_t>(rank) + 1);
}

/// In lexicographic order a point is dominated by a front exactly if the front's last member, which has its
/// smallest second objective, does not exceed the point's; those last values ascend over the fronts.
void NonDominatedSort::sweep_two(std::span<const double> objectives) {
  tails_.clear();
  double last_x = 0, last_y = 0;
  std::size_t rank = 0;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const double x = objectives[2 * std::size_t{order_[i]}];
    const double y = objectives[2 * std::size_t{order_[i]} + 1];
    if (i == 0 || x != last_x || y != last_y) {
      rank = first_greater(tails_, y);
      if (rank == tails_.size())
        tails_.push_back(y);
      else
        tails_[rank] = y;
    }
    ranks_[i] = static_cast<std::uint32_t>(rank);
    last_x = x;
    last_y = y;
  }
  gather_fronts(tails_.size());
}

/// What has come before is no worse in the first objective, so a front dominates a point if its staircase in
/// the other two covers it. Who is dominated by a front is dominated by all before it: fronts are searched
/// by halving.
void NonDominatedSort::sweep_three(std::span<const double> objectives) {
  std::size_t fronts = 0;
  const double* last = nullptr;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const double* point = objectives.data() + 3 * std::size_t{order_[i]};
    if (last != nullptr && std::equal(last, last + 3, point)) {
      ranks_[i] = ranks_[i - 1];
      continue;
    }
    last = point;
    std::size_t rank = 0;
    for (std::size_t length = fronts; length > 0;) {
      const std::size_t half = length / 2;
      const bool covered = staircases_[rank + half].covers(point[1], point[2]);
      rank += covered ? half + 1 : 0;
      length = covered ? length - half - 1 : half;
    }
    if (rank == fronts) {
      if (++fronts > staircases_.size()) staircases_.emplace_back();
      staircases_[rank].clear();
    }
    staircases_[rank].add(point[1], point[2]);
    ranks_[i] = static_cast<std::uint32_t>(rank);
  }
  gather_fronts(fronts);
}

/// Efficient non-dominated sort, sequential search (Zhang et al. 2015): earlier points in lexicographic
/// order are never dominated by later ones, so each is compared with the members of front after front.
void NonDominatedSort::sweep_many(std::span<const double> objectives, std::size_t m) {
  const auto point = [&](std::uint32_t i) { return objectives.subspan(i * m, m); };
  const auto at_most = [&](std::uint32_t a, std::uint32_t b) {
    for (std::size_t k = 1; k < m; ++k)
      if (objectives[a * m + k] > objectives[b * m + k]) return false;
    return true;
  };
  for (auto& front : members_) front.clear();
  std::size_t fronts = 0;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const std::uint32_t p = order_[i];
    if (i > 0 && std::ranges::equal(point(p), point(order_[i - 1]))) {
      ranks_[i] = ranks_[i - 1];
      continue;
    }
    std::size_t rank = 0;
    while (rank < fronts &&
           std::any_of(members_[rank].rbegin(), members_[rank].rend(), [&](auto q) { return at_most(q, p); }))
      ++rank;
    if (rank == fronts && ++fronts > members_.size()) members_.emplace_back();
    members_[rank].push_back(p);
    ranks_[i] = static_cast<std::uint32_t>(rank);
  }
  gather_fronts(fronts);
}

/// Puts the points front after front, keeping their lexicographic order.
void NonDominatedSort::gather_fronts(std::size_t fronts) {
  const std::size_t count = order_.size();
  ends_.assign(fronts + 1, 0);
  for (const std::uint32_t rank : ranks_) ++ends_[rank + 1];
  for (std::size_t k = 0; k < fronts; ++k) ends_[k + 1] += ends_[k];
  fronts_.begin.assign(ends_.begin(), ends_.end());
  fronts_.order.resize(count);
  fronts_.rank.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    fronts_.order[ends_[ranks_[i]]++] = order_[i];
    fronts_.rank[order_[i]] = static_cast<int>(ranks_[i]);
  }
}

std::vector<int> non_dominated_ranks(std::span<const double> objectives, std::size_t m) {
  NonDominatedSort sort;
  return sort(objectives, m).rank;
}

}  // namespace asterism
