// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

enum class LengthUnit { Millimetre, Centimetre, Metre, Inch };
/// "mm", "cm", "m", "inch", in the order of the enum.
[[nodiscard]] const std::vector<std::string>& length_unit_words();
[[nodiscard]] double mm_of(LengthUnit unit);
/// None for a word that is no unit.
[[nodiscard]] std::optional<LengthUnit> length_unit_of(const std::string& word);

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
