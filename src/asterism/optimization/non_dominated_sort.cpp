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
    sweep_fronts(objectives, m, staircases_);
  else
    sweep_fronts(objectives, m, trees_);
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

/// What has come before is no worse in the first objective, so a front dominates a point if one of its
/// members is at most as great in all others. Who is dominated by a front is dominated by all before it, so
/// fronts are searched by halving.
template <class Front>
void NonDominatedSort::sweep_fronts(std::span<const double> objectives, std::size_t m,
                                    std::vector<Front>& fronts) {
  std::size_t count = 0;
  const double* last = nullptr;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const double* point = objectives.data() + m * order_[i];
    if (last != nullptr && std::equal(last, last + m, point)) {
      ranks_[i] = ranks_[i - 1];
      continue;
    }
    last = point;
    std::size_t rank = 0;
    for (std::size_t length = count; length > 0;) {
      const std::size_t half = length / 2;
      const bool covered = fronts[rank + half].covers(point + 1);
      rank += covered ? half + 1 : 0;
      length = covered ? length - half - 1 : half;
    }
    if (rank == count) {
      if (++count > fronts.size()) fronts.emplace_back();
      fronts[rank].clear(m - 1);
    }
    fronts[rank].add(point + 1);
    ranks_[i] = static_cast<std::uint32_t>(rank);
  }
  gather_fronts(count);
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
