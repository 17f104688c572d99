// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/cell_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/report/base64.hpp"
#include "asterism/report/display_mesh.hpp"
#include "asterism/report/page_json.hpp"

namespace asterism {

using Json = nlohmann::json;

namespace {

std::string vertices_as_text(const TriangleMesh& surface) {
  std::vector<float> numbers;
  numbers.reserve(3 * surface.vertices.size());
  for (const Vec3& vertex : surface.vertices)
    for (const double value : vertex) numbers.push_back(static_cast<float>(value));
  return base64(numbers);
}

std::string triangles_as_text(const TriangleMesh& surface) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * surface.triangles.size());
  for (const auto& triangle : surface.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  return base64(corners);
}

Json of_covariance(const Mat3& covariance) {
  if (!covariance.allFinite()) return nullptr;
  Json row = Json::array();
  append_upper(row, covariance);
  return row;
}

Json of_value(const ReportTable::Value& value) {
  struct Of {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(const std::string& text) const { return text; }
    Json operator()(double number) const { return digits(number, 7); }
  };
  return std::visit(Of{}, value);
}

Json of_curve(const ReportChart::Curve& curve) {
  require(curve.y.size() == curve.x.size(), "a curve has a y for each x");
  for (const auto* side : {&curve.low, &curve.high})
    require(side->empty() || side->size() == curve.x.size(), "a curve's band has a value for each x or none");
  require(curve.low.empty() == curve.high.empty(), "a curve's band has both sides");
  require(std::all_of(curve.x.begin(), curve.x.end(), [](double x) { return std::isfinite(x); }),
          "a curve's x are finite");
  return {{"name", curve.name},
          {"x", json_of_column(curve.x, 7)},
          {"y", json_of_column(curve.y, 6)},
          {"low", json_of_column(curve.low, 6)},
          {"high", json_of_column(curve.high, 6)},
          {"dashed", curve.dashed}};
}

}  // namespace

Json json_of_column(const std::vector<double>& values, int count) {
  Json json = Json::array();
  for (const double value : values) json.push_back(digits(value, count));
  return json;
}

Json json_of_body_view(const CellReport::BodyView& body) {
  Json targets = Json::array(), pose = Json::array(), sight = Json::array();
  for (const Target& target : body.targets) targets.push_back(json_of_target(target));
  for (const RigidMotion& motion : body.tracker_from_body) {
    require(is_finite(motion), "a body's poses are finite");
    pose.push_back(json_of_motion(motion));
  }
  for (const auto& sides : body.sight) sight.push_back(Json::array({sides[0], sides[1]}));
  return {{"name", body.name}, {"targets", targets}, {"pose", pose}, {"sight", sight}};
}

Json json_of_solid_view(const CellReport::SolidView& solid, std::vector<std::string>& remarks) {
  const DisplayMesh shown = thinned(solid.surface, solid.error_mm, kMostTriangles);
  if (shown.cell_mm > 0) {
    remarks.push_back(
        fmt::format("{} has {} triangles; the view draws {} of them, details below {:.0f} mm are merged. All "
                    "figures were computed on the whole surface.",
                    solid.name, solid.surface.triangles.size(), shown.surface.triangles.size(),
                    std::ceil(shown.cell_mm)));
  }
  return {{"name", solid.name},
          {"role", solid.role},
          {"carrier", solid.carrier},
          {"vertices", vertices_as_text(shown.surface)},
          {"triangles", triangles_as_text(shown.surface)},
          {"error_mm", json_of_column(shown.value, 4)}};
}

Json json_of_axes(const CellReport::FrameAxes& axes) {
  return {{"name", axes.name}, {"carrier", axes.carrier}, {"pose", json_of_motion(axes.carrier_from_frame)}};
}

Json json_of_point_errors(const CellReport::PointErrors& point) {
  Json covariances = Json::array();
  for (const Mat3& covariance : point.predicted_covariance) covariances.push_back(of_covariance(covariance));
  return {{"name", point.name},
          {"position_mm", json_of(point.in_body)},
          {"predicted_mm", json_of_column(point.predicted_mm)},
          {"covariance_mm2", covariances},
          {"measured_mm", json_of_column(point.measured_mm)},
          {"without_mm", json_of_column(point.without_mm)}};
}

Json json_of_heat(const CellReport::Heat& heat) {
  Json rows = Json::array();
  for (const auto& row : heat.value) rows.push_back(json_of_column(row));
  return {{"title", heat.title},
          {"x_label", heat.x_label},
          {"y_label", heat.y_label},
          {"value_label", heat.value_label},
          {"x", json_of_column(heat.x, 7)},
          {"y", json_of_column(heat.y, 7)},
          {"value", rows}};
}

Json json_of_table(const ReportTable& table) {
  require(table.verdicts.empty() || table.verdicts.size() == table.rows.size(),
          "a table has a verdict a row or none");
  Json rows = Json::array(), verdicts = Json::array();
  for (const auto& row : table.rows) {
    require(row.size() == table.columns.size(), "a row has a value for each column");
    Json values = Json::array();
    for (const ReportTable::Value& value : row) values.push_back(of_value(value));
    rows.push_back(values);
  }
  for (const Verdict verdict : table.verdicts) verdicts.push_back(word_of(verdict));
  return {{"id", table.id},           {"title", table.title}, {"note", table.note},
          {"columns", table.columns}, {"rows", rows},         {"verdicts", verdicts}};
}

Json json_of_chart(const ReportChart& chart) {
  Json curves = Json::array(), limits = Json::array();
  for (const auto& curve : chart.curves) curves.push_back(of_curve(curve));
  for (const auto& [name, value] : chart.limits)
    limits.push_back({{"name", name}, {"value", digits(value, 6)}});
  return {{"id", chart.id},           {"title", chart.title},     {"note", chart.note},
          {"x_label", chart.x_label}, {"y_label", chart.y_label}, {"log_x", chart.log_x},
          {"log_y", chart.log_y},     {"curves", curves},         {"limits", limits}};
}

}  // namespace asterism
