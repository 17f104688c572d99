// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// A surface from STL (ascii, binary), OBJ, OFF or PLY (ascii, binary of either byte order), by the ending of
/// its name. Polygons are cut into fans, corners in one place become one vertex; colours, normals, textures
/// and whatever else a file holds are passed over. Coordinates as they stand in the file, which tells no
/// unit: see mesh_scale.hpp. Memory stays in proportion to the file, whatever it claims to hold. Throws
/// InputError with line or byte for: a cut-off or damaged file, a number that is not finite, a corner that is
/// not there, no triangle at all.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& file);

/// As binary STL: single precision, each triangle by itself.
void write_stl(const std::filesystem::path& file, const TriangleMesh& mesh);
/// As binary little-endian PLY: double precision, read back to the same bits.
void write_ply(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace asterism
