// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace asterism {

/// A mark of numbers in their order, bit for bit (FNV-1a, 64 bits): tells whether two runs came to the same.
class Checksum {
 public:
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 0; shift < 64; shift += 8) mark_ = (mark_ ^ (bits >> shift & 0xFF)) * 0x100000001b3;
  }
  void add(std::span<const double> values) {
    for (const double value : values) add(value);
  }
  [[nodiscard]] std::uint64_t value() const { return mark_; }

 private:
  std::uint64_t mark_ = 0xcbf29ce484222325;
};

}  // namespace asterism
