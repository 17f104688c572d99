// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asterism {

/// A table of bits, row by row, in words of 64.
class BitRows {
 public:
  BitRows() = default;
  BitRows(std::size_t rows, std::size_t columns)
      : columns_(columns), words_((columns + 63) / 64), bits_(rows * words_) {}

  [[nodiscard]] std::size_t rows() const { return words_ > 0 ? bits_.size() / words_ : 0; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t words() const { return words_; }
  [[nodiscard]] std::span<std::uint64_t> row(std::size_t i) {
    return std::span(bits_).subspan(i * words_, words_);
  }
  [[nodiscard]] std::span<const std::uint64_t> row(std::size_t i) const {
    return std::span(bits_).subspan(i * words_, words_);
  }
  void append(const BitRows& below) { bits_.insert(bits_.end(), below.bits_.begin(), below.bits_.end()); }

 private:
  std::size_t columns_ = 0, words_ = 0;
  std::vector<std::uint64_t> bits_;
};

[[nodiscard]] inline bool bit_at(std::span<const std::uint64_t> row, std::size_t column) {
  return (row[column / 64] >> (column % 64) & 1U) != 0;
}
inline void set_bit(std::span<std::uint64_t> row, std::size_t column) {
  row[column / 64] |= std::uint64_t{1} << (column % 64);
}
inline void clear_bit(std::span<std::uint64_t> row, std::size_t column) {
  row[column / 64] &= ~(std::uint64_t{1} << (column % 64));
}
/// Calls `visit(column)` for each bit that is set, ascending.
template <class Visit>
void for_each_bit(std::span<const std::uint64_t> row, const Visit& visit) {
  for (std::size_t word = 0; word < row.size(); ++word) {
    for (std::uint64_t rest = row[word]; rest != 0; rest &= rest - 1) {
      visit(64 * word + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }
}
[[nodiscard]] inline std::size_t count_bits(std::span<const std::uint64_t> row) {
  std::size_t count = 0;
  for (const std::uint64_t word : row) count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

}  // namespace asterism
