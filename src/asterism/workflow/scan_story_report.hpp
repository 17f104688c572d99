// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/evaluation/pose_errors.hpp"
#include "asterism/report/scan_report.hpp"
#include "asterism/workflow/scan_story.hpp"

namespace asterism {

/// What else the paper's conclusion tells in figures.
struct HeadlineFigures {
  std::vector<PoseErrors> errors;        // of the dynamic scan, at each body's target centroid
  std::optional<double> least_coverage;  // the paper's field-of-view coefficient, over the motion
  std::optional<ScanPlan> rings;         // stations on rings in the same cell, platform turned
};

/// How many of the rounds' views, taken in the order of what each adds, measure as much as `area_mm2`; none
/// when all of them measure less. The rounds' plans have the same samples.
[[nodiscard]] std::optional<std::size_t> views_for_area(std::span<const ScanRound> rounds, double area_mm2);

/// The paper's headline figures beside ours, each with its definition; then the cloud's.
[[nodiscard]] std::vector<SummaryRow> story_rows(std::span<const ScanRound> rounds,
                                                 const HeadlineFigures& headline, double tolerance_mm);

/// Plan, cloud before and after, completeness, deviation: for one page.
[[nodiscard]] ScanReport story_report(const Cell& cell, std::span<const ScanRound> rounds,
                                      const HeadlineFigures& headline);

}  // namespace asterism
