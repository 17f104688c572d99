// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asterism {

/// Thins a front of two objectives: again and again the point is left out whose sole share of the dominated
/// area (its hypervolume contribution) is smallest, until `keep` remain. The two ends, which have a
/// neighbour on one side only, count as infinite. O(n log n): the front is a linked list, and shares only
/// grow when a neighbour goes, so a heap of outdated shares is enough.
class FrontThinning {
 public:
  /// Point i of the front is (x[i], y[i]), x ascending and y descending (copies of a point side by side).
  /// Returns the positions kept, ascending; valid until the next call.
  std::span<const std::uint32_t> operator()(std::span<const double> x, std::span<const double> y,
                                            std::size_t keep);
  /// Shares of the points kept, in the order returned.
  [[nodiscard]] std::span<const double> contributions() const { return contributions_; }

 private:
  struct Share {
    double area;
    std::uint32_t at;
  };
  [[nodiscard]] double area(std::span<const double> x, std::span<const double> y, std::uint32_t at) const;
  void sift_down(std::size_t at);

  std::vector<std::uint32_t> previous_, next_;
  std::vector<Share> heap_;
  std::vector<std::uint32_t> kept_;
  std::vector<double> contributions_;
};

}  // namespace asterism
