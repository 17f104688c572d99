// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "asterism/scanning/planner.hpp"

namespace asterism {

/// Plans the views of a cell and writes them.
struct PlanJob {
  std::filesystem::path out;       // plan.json; empty: nothing is written
  std::filesystem::path complete;  // a cloud in the workpiece's frame: only what it lacks is planned
  PlanOptions options;
  CompletenessOptions completeness;
  std::uint64_t seed = 1;
};
[[nodiscard]] ScanPlan plan_cell(const Cell& cell, const PlanJob& job, const Progress& progress);

/// For the terminal: views and bound, coverage against three denominators, what each limit costs, the tour.
[[nodiscard]] std::string text_of(const ScanPlan& plan);
/// The same as JSON; the views are in plan.json (docs/formats.md).
[[nodiscard]] nlohmann::ordered_json summary_of(const ScanPlan& plan);

}  // namespace asterism
