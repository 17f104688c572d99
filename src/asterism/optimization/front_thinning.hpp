// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asterism {

/// Thins a front of two objectives: again and again the point is left out whose sole share of the dominated
/// area (its hypervolume contribution) is smallest, until `keep` remain. The two ends, which have a
/// neighbour on one side only, count as infinite and go last. O(n log n): the front is a linked list, and
/// the smallest share stands at the root of a tree of minima.
class FrontThinning {
 public:
  /// Point i of the front is (x[i], y[i]), x ascending and y descending (copies of a point side by side).
  /// Returns the positions kept, ascending; valid until the next call.
  std::span<const std::uint32_t> operator()(std::span<const double> x, std::span<const double> y,
                                            std::size_t keep);
  /// Shares of the points kept, in the order returned.
  [[nodiscard]] std::span<const double> contributions() const { return contributions_; }

 private:
  void plant(std::size_t count);
  void leave_out_least();
  void set_share(std::size_t at, double share);
  [[nodiscard]] double share(std::size_t at) const;

  std::span<const double> x_, y_;
  std::vector<std::uint32_t> previous_, next_;  // an end is its own neighbour
  std::vector<double> least_;  // node i has children 2 i and 2 i + 1; the leaves are the points' shares
  std::size_t leaves_ = 0;
  std::vector<std::uint32_t> kept_;
  std::vector<double> contributions_;
};

}  // namespace asterism
