// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asterism/camera/image.hpp"

namespace asterism {

/// A grey image of 8 or 16 bits from PNG, TIFF, BMP, PGM or JPEG; colour is converted to grey, rotation
/// tags are not obeyed (pixels stay where the sensor had them). Throws InputError naming the file when it
/// is missing, of another kind, or cut off: half an image is no image.
[[nodiscard]] Image read_image(const std::filesystem::path& file);

/// The format follows from the name's ending.
void write_image(const std::filesystem::path& file, const Image& image);

/// The images of a folder, or those a pattern with * and ? names ("left/*.png"), or one file; in the order
/// people count (img2 before img10). Throws InputError when there are none.
[[nodiscard]] std::vector<std::filesystem::path> list_images(const std::string& folder_or_pattern);

}  // namespace asterism
