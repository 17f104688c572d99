// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "asterism/report/cell_report.hpp"

namespace asterism::app {

/// A table for a terminal: an empty line, its title, columns that line up, its note.
[[nodiscard]] std::string text_of_table(const ReportTable& table);

}  // namespace asterism::app
