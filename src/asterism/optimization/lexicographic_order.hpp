// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asterism {

/// Sorts points by their first coordinate, ties by the second and so on, wholly equal points by their index.
/// Values are dealt into as many buckets as there are points (linear interpolation between the smallest and
/// the largest), so evenly spread values take linear time; skewed ones end in a comparison sort. Its memory
/// is reused from call to call.
class LexicographicOrder {
 public:
  /// Indices of the `points` (count × m, row-major, none NaN) in order; valid until the next call.
  std::span<const std::uint32_t> operator()(std::span<const double> points, std::size_t m);

 private:
  struct Key {
    double value;  // the coordinate now sorted by
    std::uint32_t index;
  };
  struct Range {
    std::size_t first, last;
  };

  [[nodiscard]] bool before(const Key& a, const Key& b, std::size_t coordinate) const;
  void sort(Range range, std::size_t coordinate, int depth);
  void sort_few(Range range, std::size_t coordinate);
  void sort_equal(Range range, std::size_t coordinate);
  bool deal(Range range, double low, double high, std::size_t coordinate, int depth);

  std::span<const double> points_;
  std::size_t m_ = 0;
  std::vector<Key> keys_, dealt_;
  std::vector<std::uint32_t> bucket_ends_;
  std::vector<std::uint32_t> order_;
};

}  // namespace asterism
