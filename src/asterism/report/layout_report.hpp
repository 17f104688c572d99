// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/layout/designer.hpp"
#include "asterism/report/summary_row.hpp"

namespace asterism {

/// Layouts of the targets of one body, found and given, as a page shows them.
struct LayoutReport {
  std::string title;
  std::string subtitle;              // one line: cell, candidates, time, program
  std::vector<SummaryRow> summary;   // what was found
  std::vector<std::string> remarks;  // what to beware of, in words
  Cell cell;                         // with its layout task
  std::vector<double> pose_times_s;  // of the poses that the designs were looked at in
  std::vector<LayoutDesign> found;
  int knee = -1;                    // a place in `found`
  std::string why;                  // that one is the knee
  std::vector<LayoutDesign> given;  // the present layout first; to compare with
  std::vector<GenerationRecord> history;
  std::string options_json;  // the effective options; empty = none
};

/// The report's data as the page reads it (web/src/data/layout.ts is the same list). Lengths mm, angles deg;
/// a number that is not finite becomes null.
[[nodiscard]] std::string layout_report_json(const LayoutReport& report);

/// One HTML file that opens from disk, with everything inside. The file appears whole or not at all.
/// Throws InputError when it cannot be written.
void write_layout_report(const std::filesystem::path& path, const LayoutReport& report);

}  // namespace asterism
