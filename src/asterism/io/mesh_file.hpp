// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// A surface from STL (ascii, binary), OBJ, OFF or PLY (ascii, binary of either byte order), by the ending of
/// its name. Polygons are cut into fans, corners in one place become one vertex; colours, normals, textures
/// and whatever else a file holds are passed over. Coordinates as they stand in the file, which tells no
/// unit: see checked_mesh. Memory stays in proportion to the file, whatever it claims to hold. Throws
/// InputError with line or byte for: a cut-off or damaged file, a number that is not finite, a corner that is
/// not there, no triangle at all.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& file);

/// As binary STL: single precision, each triangle by itself.
void write_stl(const std::filesystem::path& file, const TriangleMesh& mesh);
/// As binary little-endian PLY: double precision, read back to the same bits.
void write_ply(const std::filesystem::path& file, const TriangleMesh& mesh);

enum class LengthUnit { Millimetre, Centimetre, Metre, Inch };
/// "mm", "cm", "m", "inch", in the order of the enum.
[[nodiscard]] const std::vector<std::string>& length_unit_words();

/// How a file's numbers become millimetres: by their unit, or by the longest edge of the box around them.
struct MeshScale {
  std::optional<LengthUnit> unit;
  std::optional<double> longest_mm;
  bool flip = false;  // the file's triangles face inwards
};

/// The surface in millimetres. Throws InputError, at `where`, when neither or both of unit and length are
/// told; for a part of less than 5 mm or more than 50 m from corner to corner, with the unit that would be
/// plausible; for a surface without area, or a closed one that is inside out. What is merely odd (open, not
/// manifold) is let through: remarks_on(cell) tells it.
[[nodiscard]] TriangleMesh checked_mesh(TriangleMesh mesh, const MeshScale& scale, const std::string& where);

}  // namespace asterism
