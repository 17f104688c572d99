// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/dominance_tree.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace asterism {

void DominanceTree::clear(std::size_t m) {
  m_ = m;
  nodes_.clear();
  corners_.clear();
  slots_.clear();
  make_leaf(new_slots());
}

bool DominanceTree::covers(const double* point) const {
  const auto may_cover = [&](std::uint32_t node) {
    const double* corner = corners_.data() + node * m_;
    bool below = true;
    for (std::size_t k = 0; k < m_; ++k) below &= corner[k] <= point[k];
    return below;
  };
  to_visit_.clear();
  std::uint32_t at = 0;
  for (;;) {
    if (may_cover(at)) {
      const Node& node = nodes_[at];
      if (node.low != 0) {
        if (point[node.axis] >= node.split) to_visit_.push_back(node.high);
        at = node.low;
        continue;
      }
      if (leaf_covers(node, point)) return true;
    }
    if (to_visit_.empty()) return false;
    at = to_visit_.back();
    to_visit_.pop_back();
  }
}

void DominanceTree::add(const double* point) {
  std::uint32_t at = 0;
  for (;;) {
    double* corner = corners_.data() + at * m_;
    for (std::size_t k = 0; k < m_; ++k) corner[k] = std::min(corner[k], point[k]);
    const Node& node = nodes_[at];
    if (node.low == 0) break;
    at = point[node.axis] < node.split ? node.low : node.high;
  }
  if (nodes_[at].count < kLeaf) return put(at, point);
  split(at);
  add(point);
}

std::uint32_t DominanceTree::make_leaf(std::uint32_t slots) {
  nodes_.push_back({});
  nodes_.back().slots = slots;
  corners_.resize(nodes_.size() * m_, std::numeric_limits<double>::infinity());
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

/// Empty slots hold what is at most nothing.
std::uint32_t DominanceTree::new_slots() {
  const auto first = static_cast<std::uint32_t>(slots_.size());
  slots_.resize(slots_.size() + m_ * kLeaf, std::numeric_limits<double>::quiet_NaN());
  return first;
}

void DominanceTree::put(std::uint32_t leaf, const double* point) {
  Node& node = nodes_[leaf];
  for (std::size_t k = 0; k < m_; ++k) {
    slots_[node.slots + k * kLeaf + node.count] = point[k];
    double& corner = corners_[leaf * m_ + k];
    corner = std::min(corner, point[k]);
  }
  ++node.count;
}

/// Halves a full leaf where its points lie furthest apart. No two of them are equal, so there is such an
/// axis; among many equal values the split goes beside them.
void DominanceTree::split(std::uint32_t leaf) {
  std::uint32_t axis = 0;
  double longest = -1;
  for (std::uint32_t k = 0; k < m_; ++k) {
    const auto [low, high] = std::minmax_element(&slots_[nodes_[leaf].slots + k * kLeaf],
                                                 &slots_[nodes_[leaf].slots + k * kLeaf] + kLeaf);
    if (*high - *low > longest) {
      longest = *high - *low;
      axis = k;
    }
  }
  const std::uint32_t old = nodes_[leaf].slots;
  std::array<double, kLeaf> values;
  std::copy_n(&slots_[old + axis * kLeaf], kLeaf, values.begin());
  std::ranges::sort(values);
  double split = values[kLeaf / 2];
  if (split == values[0]) split = *std::ranges::upper_bound(values, split);

  std::vector<double> points(&slots_[old], &slots_[old] + m_ * kLeaf);
  std::fill_n(&slots_[old], m_ * kLeaf, std::numeric_limits<double>::quiet_NaN());
  const std::uint32_t low = make_leaf(old);
  const std::uint32_t high = make_leaf(new_slots());
  std::vector<double> point(m_);
  for (std::size_t i = 0; i < kLeaf; ++i) {
    for (std::size_t k = 0; k < m_; ++k) point[k] = points[k * kLeaf + i];
    put(point[axis] < split ? low : high, point.data());
  }
  nodes_[leaf] = {split, axis, low, high, 0, 0};
}

bool DominanceTree::leaf_covers(const Node& leaf, const double* point) const {
  std::array<std::int64_t, kLeaf> below;
  below.fill(-1);
  const double* slot = slots_.data() + leaf.slots;
  for (std::size_t k = 0; k < m_; ++k, slot += kLeaf)
    for (std::size_t i = 0; i < kLeaf; ++i) below[i] &= slot[i] <= point[k] ? -1 : 0;
  std::int64_t any = 0;
  for (std::size_t i = 0; i < kLeaf; ++i) any |= below[i];
  return any != 0;
}

}  // namespace asterism
