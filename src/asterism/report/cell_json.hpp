// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "asterism/report/cell_report.hpp"

// The pieces of a cell report as the page reads them (web/src/data/cell_report.ts).

namespace asterism {

/// More triangles than this are thinned out for drawing: a page holds two megabytes of them, no twenty.
inline constexpr std::size_t kMostTriangles = 60000;

/// Each to so many digits; null for a number that is not finite.
[[nodiscard]] nlohmann::json json_of_column(const std::vector<double>& values, int count = 5);

[[nodiscard]] nlohmann::json json_of_body_view(const CellReport::BodyView& body);
/// A surface that had to be thinned is told of in `remarks`.
[[nodiscard]] nlohmann::json json_of_solid_view(const CellReport::SolidView& solid,
                                                std::vector<std::string>& remarks);
[[nodiscard]] nlohmann::json json_of_axes(const CellReport::FrameAxes& axes);
[[nodiscard]] nlohmann::json json_of_point_errors(const CellReport::PointErrors& point);
[[nodiscard]] nlohmann::json json_of_heat(const CellReport::Heat& heat);
[[nodiscard]] nlohmann::json json_of_table(const ReportTable& table);
[[nodiscard]] nlohmann::json json_of_chart(const ReportChart& chart);

}  // namespace asterism
