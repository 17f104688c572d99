// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace asterism {

/// RFC 4648, with padding; numbers as little-endian bytes whatever the machine.
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);
[[nodiscard]] std::string base64(std::span<const std::uint16_t> numbers);
[[nodiscard]] std::string base64(std::span<const float> numbers);
[[nodiscard]] std::string base64(std::span<const std::uint32_t> numbers);

}  // namespace asterism
