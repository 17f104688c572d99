// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "asterism/core/progress.hpp"
#include "asterism/measurement/cloud.hpp"
#include "asterism/scanning/completeness.hpp"
#include "asterism/scanning/plan_options.hpp"

namespace asterism {

/// What was scanned before, in the workpiece's frame, and when a place counts as measured by it.
struct EarlierCloud {
  Cloud cloud;
  CompletenessOptions completeness;
};

/// The fewest views that measure what the task asks for, in which poses of the platform, in which order:
/// surface samples → candidates → measurability and what the cell allows → anew where places stay uncovered
/// → set cover → poses → tour. The bound is of the set cover over these candidates, in views or, by the
/// objective, in time. Coverage is told against the whole surface, what any candidate reaches, and what this
/// cell allows. Throws InputError for a cell without scanner or workpiece, or whose part faces inwards or
/// different ways; MeasurementError, naming the limits, when no view can be taken at all.
[[nodiscard]] ScanPlan plan_scans(const Cell& cell, const PlanOptions& options, std::uint64_t seed,
                                  const EarlierCloud& earlier, const Progress& progress);

}  // namespace asterism
