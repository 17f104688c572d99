// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace asterism {

/// The check sum of PNG, zip and Ethernet (polynomial 0x04C11DB7, reflected).
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

}  // namespace asterism
