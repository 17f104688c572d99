// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asterism {

/// Points of any number of coordinates, to be asked whether one of them is at most a given point in all:
/// a k-d tree whose nodes know their lower corner, with leaves of sixteen points that are compared at once
/// (after ENS-NDT, Gustavsson & Syberfeldt 2018).
class DominanceTree {
 public:
  /// Empties the tree; its points will have `m` coordinates.
  void clear(std::size_t m);
  [[nodiscard]] bool covers(const double* point) const;
  /// Adds a point that is not covered.
  void add(const double* point);

 private:
  static constexpr std::size_t kLeaf = 16;
  struct Node {
    double split = 0;  // inner: points below it in `axis` are in `low`
    std::uint32_t axis = 0;
    std::uint32_t low = 0;  // 0: a leaf, for the root is nobody's child
    std::uint32_t high = 0;
    std::uint32_t slots = 0;  // leaf: first of its coordinates, those of one axis side by side
    std::uint32_t count = 0;
  };

  std::uint32_t make_leaf(std::uint32_t slots);
  std::uint32_t new_slots();
  void put(std::uint32_t leaf, const double* point);
  void split(std::uint32_t leaf);
  [[nodiscard]] bool leaf_covers(const Node& leaf, const double* point) const;

  std::size_t m_ = 0;
  std::vector<Node> nodes_;
  std::vector<double> corners_;  // m per node
  std::vector<double> slots_;
  mutable std::vector<std::uint32_t> to_visit_;
};

}  // namespace asterism
