// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/cell_report.hpp"

#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/report/cell_json.hpp"
#include "asterism/report/page.hpp"
#include "asterism/report/page_json.hpp"

namespace asterism {
namespace {

using Json = nlohmann::json;

bool is_by_frame(const CellReport& report, std::size_t size) { return size == report.times_s.size(); }
bool is_by_frame_or_empty(const CellReport& report, std::size_t size) {
  return size == 0 || is_by_frame(report, size);
}

void check_bodies(const CellReport& report) {
  require(report.body < report.bodies.size(), "the verified body is one of the bodies");
  for (const auto& body : report.bodies) {
    require(is_by_frame(report, body.tracker_from_body.size()), "a body has a pose a frame");
    require(body.sight.size() == body.targets.size(), "a body has a sight a target");
    for (const auto& sides : body.sight)
      for (const std::string& letters : sides)
        require(is_by_frame(report, letters.size()), "sight has a letter a frame");
  }
}

void check_carrier(const CellReport& report, int carrier) {
  require(carrier >= -1 && carrier < static_cast<int>(report.bodies.size()),
          "a carrier is one of the bodies or the tracker");
}

void check(const CellReport& report) {
  check_bodies(report);
  for (const auto& solid : report.solids) {
    check_carrier(report, solid.carrier);
    require(solid.error_mm.empty() || solid.error_mm.size() == solid.surface.vertices.size(),
            "a solid has an error a vertex or none");
  }
  for (const auto& axes : report.axes) check_carrier(report, axes.carrier);
  for (const auto& point : report.points) {
    require(is_by_frame(report, point.predicted_mm.size()), "a point has a predicted error a frame");
    require(is_by_frame_or_empty(report, point.predicted_covariance.size()),
            "a point has a covariance a frame or none");
    require(is_by_frame_or_empty(report, point.measured_mm.size()),
            "a point has a measured error a frame or none");
    require(is_by_frame_or_empty(report, point.without_mm.size()),
            "a point has an error without targets a frame or none");
  }
  require(is_by_frame(report, report.visible.size()), "the visible count has a value a frame");
  for (const std::size_t size :
       {report.coverage.size(), report.predicted_rotation_deg.size(), report.measured_rotation_deg.size(),
        report.status.size(), report.without_mm.size(), report.without_deg.size()})
    require(is_by_frame_or_empty(report, size), "a series has a value a frame or none");
  for (const auto& heat : report.heats) {
    require(heat.value.size() == heat.y.size(), "a heat map has a row for each of its y");
    for (const auto& row : heat.value)
      require(row.size() == heat.x.size(), "a heat map has a value for each of its x");
  }
}

}  // namespace

std::string cell_report_json(const CellReport& report) {
  check(report);
  std::vector<std::string> remarks = report.remarks;
  Json bodies = Json::array(), solids = Json::array(), axes = Json::array(), points = Json::array();
  Json heats = Json::array(), tables = Json::array(), charts = Json::array();
  for (const auto& body : report.bodies) bodies.push_back(json_of_body_view(body));
  for (const auto& solid : report.solids) solids.push_back(json_of_solid_view(solid, remarks));
  for (const auto& frame : report.axes) axes.push_back(json_of_axes(frame));
  for (const auto& point : report.points) points.push_back(json_of_point_errors(point));
  for (const auto& heat : report.heats) heats.push_back(json_of_heat(heat));
  for (const auto& table : report.tables) tables.push_back(json_of_table(table));
  for (const auto& chart : report.charts) charts.push_back(json_of_chart(chart));
  const Json json = {{"schema", "asterism-cell-report/1"},
                     {"title", report.title},
                     {"subtitle", report.subtitle},
                     {"summary", json_of_summary(report.summary)},
                     {"remarks", remarks},
                     {"rig", json_of_rig(report.rig)},
                     {"volume", json_of_volume(report.volume, report.rig)},
                     {"time_s", json_of_column(report.times_s, 9)},
                     {"bodies", bodies},
                     {"solids", solids},
                     {"axes", axes},
                     {"body", report.body},
                     {"visible", report.visible},
                     {"coverage", json_of_column(report.coverage)},
                     {"points", points},
                     {"predicted_rotation_deg", json_of_column(report.predicted_rotation_deg)},
                     {"measured_rotation_deg", json_of_column(report.measured_rotation_deg)},
                     {"status", report.status},
                     {"without_mm", json_of_column(report.without_mm)},
                     {"without_deg", json_of_column(report.without_deg)},
                     {"tolerance_mm", digits(report.tolerance_mm, 6)},
                     {"nominal_mm", digits(report.nominal_mm, 6)},
                     {"heats", heats},
                     {"tables", tables},
                     {"charts", charts},
                     {"options", json_of_stored(report.options_json)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_cell_report(const std::filesystem::path& path, const CellReport& report) {
  write_file(path, page_with_data(report_page(), cell_report_json(report)));
}

}  // namespace asterism
