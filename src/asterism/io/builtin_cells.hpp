// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace asterism {

/// A cell of examples/cells whose text is part of the program (made by CMake from builtin_cells.cpp.in).
struct BuiltinCell {
  std::string_view name, toml;
};
[[nodiscard]] std::span<const BuiltinCell> builtin_cell_texts();

}  // namespace asterism
