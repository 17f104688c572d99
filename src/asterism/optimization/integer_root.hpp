// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "asterism/core/lanes.hpp"

namespace asterism {

/// x^n for n ≥ 0 by repeated squaring, of a number or of lanes.
template <class Number>
[[nodiscard]] ASTERISM_INLINE Number integer_power(Number x, int n) {
  Number power = x * 0 + 1;
  for (; n > 0; n >>= 1) {
    if ((n & 1) != 0) power *= x;
    x *= x;
  }
  return power;
}

/// x^(1/n) of positive normal numbers to 6e-15 of the value, in a few nanoseconds and with the same
/// bits on every machine, which std::pow does not promise. With x = 2^k·c·(1 + d), c the middle of one of
/// 64 cells of the mantissa, the first two roots come from tables and the last from five terms of the
/// binomial series (|d| < 1/128: what is left out is below 5e-15).
class IntegerRoot {
 public:
  /// 1 ≤ n ≤ 1000.
  explicit IntegerRoot(int n);

  /// Of four numbers at once, the same bits as one by one.
  ASTERISM_INLINE DoubleLanes operator()(DoubleLanes x) const {
    const WordLanes bits = reinterpret_cast<WordLanes>(x);
    const WordLanes exponent = bits >> 52;
    const WordLanes cell = (bits >> 46) & (kCells - 1);
    const DoubleLanes mantissa = reinterpret_cast<DoubleLanes>((bits & kMantissaBits) | kBitsOfOne);
    DoubleLanes inverse, root, power;
    for (std::size_t lane = 0; lane < kDoubleLanes; ++lane) {
      inverse[lane] = cell_inverse_[cell[lane]];
      root[lane] = cell_root_[cell[lane]];
      power[lane] = exponent_root_[exponent[lane]];
    }
    const DoubleLanes d = mantissa * inverse - 1;
    const DoubleLanes series =
        1 + d * (series_[0] + d * (series_[1] + d * (series_[2] + d * (series_[3] + d * series_[4]))));
    return power * (root * series);
  }

  [[nodiscard]] double operator()(double x) const {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::size_t exponent = bits >> 52;
    const std::size_t cell = (bits >> 46) & (kCells - 1);
    const double mantissa = std::bit_cast<double>((bits & kMantissaBits) | kBitsOfOne);
    const double d = mantissa * cell_inverse_[cell] - 1;
    const double series =
        1 + d * (series_[0] + d * (series_[1] + d * (series_[2] + d * (series_[3] + d * series_[4]))));
    return exponent_root_[exponent] * (cell_root_[cell] * series);
  }

 private:
  using WordLanes = std::uint64_t __attribute__((vector_size(sizeof(DoubleLanes))));
  static constexpr std::size_t kCells = 64;
  static constexpr std::uint64_t kMantissaBits = (std::uint64_t{1} << 52) - 1;
  static constexpr std::uint64_t kBitsOfOne = std::uint64_t{1023} << 52;

  std::array<double, 5> series_;
  std::array<double, kCells> cell_inverse_, cell_root_;
  std::vector<double> exponent_root_;  // of 2^k, by the biased exponent
};

}  // namespace asterism
