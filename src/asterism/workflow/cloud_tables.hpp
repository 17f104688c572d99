// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "asterism/report/cell_report.hpp"
#include "asterism/scanning/completeness.hpp"
#include "asterism/scanning/deviation.hpp"

// What a cloud measures of a surface and how far it lies off, for terminal, page and JSON.

namespace asterism {

/// Whole and regions, a row each.
[[nodiscard]] ReportTable deviation_table(const Deviation& deviation, const DeviationOptions& options);
/// The largest `most` of them.
[[nodiscard]] ReportTable hole_table(const Completeness& completeness, std::size_t most = 12);
/// The histogram as shares, with the tolerance.
[[nodiscard]] ReportChart deviation_chart(const Deviation& deviation, const DeviationOptions& options);

[[nodiscard]] nlohmann::ordered_json json_of(const Deviation& deviation, const DeviationOptions& options);
[[nodiscard]] nlohmann::ordered_json json_of(const Completeness& completeness);

}  // namespace asterism
