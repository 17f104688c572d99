// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asterism/cell/cell.hpp"

namespace asterism {

/// A measuring cell from TOML (docs/formats.md has every key, `asterism schema` prints them). Files named in
/// it are sought beside it, meshes in ASTERISM_DATA_PATH as well. Throws InputError, with file and line, for
/// an unknown key (and the nearest name), a wrong type, a missing value, a mesh that is none; then
/// check_cell.
[[nodiscard]] Cell read_cell(const std::filesystem::path& file);

/// As TOML that read_cell takes back to the same cell: all poses in the tracker's frame, lens by lens, each
/// solid's surface as a PLY file beside it (CELL.workpiece.ply, CELL.fixture-1.ply …).
void write_cell(const std::filesystem::path& file, const Cell& cell);

/// Cells that come with the program, by name: "engine_casing", "paper_cell", "turbine_casing".
[[nodiscard]] std::vector<std::string> builtin_cells();

/// A built-in cell by its name, else a file.
[[nodiscard]] Cell cell_of(const std::string& name_or_file);

}  // namespace asterism
