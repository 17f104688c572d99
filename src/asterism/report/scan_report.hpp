// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asterism/cell/scanner.hpp"
#include "asterism/geometry/triangle_mesh.hpp"
#include "asterism/measurement/cloud.hpp"
#include "asterism/report/cell_report.hpp"
#include "asterism/report/summary_row.hpp"
#include "asterism/scanning/completeness.hpp"
#include "asterism/scanning/deviation.hpp"
#include "asterism/scanning/scan_plan.hpp"

namespace asterism {

/// Plan, scans and cloud of a part, for a page. All in the workpiece's frame.
struct ScanReport {
  /// One round: what was planned, what the cloud held after it.
  struct Round {
    std::string name;  // "platform at rest", "platform turned by 10°"
    std::optional<ScanPlan> plan;
    std::optional<Cloud> cloud;  // all points so far; thinned for the page
    std::optional<Completeness> completeness;
    std::optional<Deviation> deviation;  // one value a point of the cloud
  };

  /// Another page that lies beside this one.
  struct Link {
    std::string text, href;  // relative to this page
  };

  std::string title, subtitle;
  std::vector<Link> links;
  std::vector<SummaryRow> summary;
  std::vector<std::string> remarks;
  Scanner scanner;                     // its field draws the frustums
  std::string part;                    // the surface's name
  TriangleMesh surface;                // may be empty: then only clouds are drawn
  std::vector<SurfaceSample> samples;  // that completeness was judged by
  std::vector<Round> rounds;
  double tolerance_mm = 0.1;
  double view_s = 5, turn_s = 10;
  std::vector<ReportTable> tables;
  std::vector<ReportChart> charts;  // coverage against number of views, …
  std::string options_json;
};

/// The data as the page reads it (web/src/data/scan_report.ts is the same list), schema
/// `asterism-scan-report/1`.
[[nodiscard]] std::string scan_report_json(const ScanReport& report);

/// One HTML file that opens from disk. Throws InputError when it cannot be written.
void write_scan_report(const std::filesystem::path& path, const ScanReport& report);

}  // namespace asterism
