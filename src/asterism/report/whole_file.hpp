// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace asterism {

/// Writes beside `path`, then renames: the file is there whole or not at all, and an older one stays until
/// then. Throws InputError naming the path when it cannot be written.
void write_whole_file(const std::filesystem::path& path, std::string_view content);

}  // namespace asterism
