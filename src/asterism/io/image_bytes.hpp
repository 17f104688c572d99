// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace asterism {

/// Why the bytes of an image file cannot be trusted, or empty. The decoders fill what is missing of a
/// cut-off file with grey, or print to standard error; so it is found out before they see it.
/// Knows PNG (every chunk and its checksum), JPEG (end marker), BMP and PGM (size), TIFF (strips inside).
[[nodiscard]] std::string fault_of_image_bytes(std::string_view bytes);

}  // namespace asterism
