// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

// Numbers in the bytes of a file.

namespace asterism {

/// The number at the begin of `bytes`, which are enough for it.
template <class Number>
[[nodiscard]] Number number_at(std::string_view bytes, std::endian order = std::endian::little) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), bytes.data(), sizeof(Number));
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

/// Little-endian.
template <class Number>
void append_number(std::string& bytes, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (std::endian::native != std::endian::little) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

}  // namespace asterism
