// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "asterism/cell/robot.hpp"
#include "asterism/cell/scan_task.hpp"
#include "asterism/io/cell_section.hpp"
#include "asterism/io/cell_tables.hpp"

// [scan], what is asked of a plan of views, and [robot], the arm that carries the scanner. For .cpp files
// only.

namespace asterism {

[[nodiscard]] ScanTask scan_task_of(const CellSection& section);
[[nodiscard]] Robot robot_of(const CellSection& section, const Places& places);

/// What follows [scan]'s options in a file: its floor and regions.
[[nodiscard]] std::string rest_of(const ScanTask& task);
[[nodiscard]] std::string text_of(const Robot& robot);

}  // namespace asterism
