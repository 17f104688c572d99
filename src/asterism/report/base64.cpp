// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/base64.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace asterism {
namespace {

template <typename Number>
std::string as_bytes(std::span<const Number> numbers) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(sizeof(Number) * numbers.size());
  for (const Number number : numbers)
    for (unsigned shift = 0; shift < 8 * sizeof(Number); shift += 8)
      bytes.push_back(static_cast<std::uint8_t>(number >> shift));
  return base64(bytes);
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < there ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= there ? kLetters[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string base64(std::span<const std::uint16_t> numbers) { return as_bytes(numbers); }
std::string base64(std::span<const std::uint32_t> numbers) { return as_bytes(numbers); }

std::string base64(std::span<const float> numbers) {
  std::vector<std::uint32_t> words;
  words.reserve(numbers.size());
  for (const float number : numbers) words.push_back(std::bit_cast<std::uint32_t>(number));
  return base64(words);
}

}  // namespace asterism
