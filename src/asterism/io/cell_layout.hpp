// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "asterism/cell/cell.hpp"
#include "asterism/io/cell_section.hpp"

// [tracker.volume] and [layout] of a cell file. For .cpp files only.

namespace asterism {

/// By its six sizes, or by `preset` alone.
[[nodiscard]] WorkingVolume working_volume_of(const CellSection& section);

/// The options of LayoutTask with [[layout.patch]], [[layout.keep_out]] and [[layout.point]].
[[nodiscard]] LayoutTask layout_task_of(const CellSection& section);

/// The lists of a layout task as TOML that layout_task_of takes back; its options are not among them.
[[nodiscard]] std::string lists_of(const LayoutTask& task);

}  // namespace asterism
