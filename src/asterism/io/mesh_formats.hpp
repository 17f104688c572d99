// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "asterism/geometry/triangle_mesh.hpp"

// One reader a format, from the whole of a file; `file` is for messages only. Used by mesh_file.cpp.

namespace asterism {

[[nodiscard]] TriangleMesh mesh_of_stl(std::string_view bytes, const std::filesystem::path& file);
[[nodiscard]] TriangleMesh mesh_of_obj(std::string_view text, const std::filesystem::path& file);
[[nodiscard]] TriangleMesh mesh_of_off(std::string_view text, const std::filesystem::path& file);
[[nodiscard]] TriangleMesh mesh_of_ply(std::string_view bytes, const std::filesystem::path& file);

}  // namespace asterism
