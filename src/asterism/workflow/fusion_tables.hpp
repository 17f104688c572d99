// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/evaluation/fusion.hpp"
#include "asterism/report/cell_report.hpp"

namespace asterism {

/// What an occlusion costs with and without the platform's read-out, by its length; and the latency told.
[[nodiscard]] std::vector<ReportTable> fusion_tables(const FusionStudy& study);

/// The error over time with its 95 % band on both roads, against the tolerance; and RMS error over length.
[[nodiscard]] std::vector<ReportChart> fusion_charts(const FusionStudy& study, double tolerance_mm);

}  // namespace asterism
