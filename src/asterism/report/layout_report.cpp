// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/layout_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/report/layout_words.hpp"
#include "asterism/report/page.hpp"
#include "asterism/report/page_json.hpp"

namespace asterism {
namespace {

using Json = nlohmann::json;

Json of_patch(const NamedPatch& named) {
  struct Of {
    Json operator()(const CylinderSide& p) const {
      return {{"kind", "side"},
              {"base_mm", json_of(p.base_mm)},
              {"radius_mm", p.radius_mm},
              {"height_mm", p.height_mm},
              {"from_deg", deg_from_rad(p.from_rad)},
              {"to_deg", deg_from_rad(p.to_rad)}};
    }
    Json operator()(const Annulus& p) const {
      return {{"kind", "ring"},
              {"centre_mm", json_of(p.centre_mm)},
              {"inner_radius_mm", p.inner_radius_mm},
              {"outer_radius_mm", p.outer_radius_mm},
              {"from_deg", deg_from_rad(p.from_rad)},
              {"to_deg", deg_from_rad(p.to_rad)}};
    }
    Json operator()(const Plate& p) const {
      return {{"kind", "plate"},
              {"pose", json_of_motion(p.body_from_plate)},
              {"width_mm", p.width_mm},
              {"height_mm", p.height_mm}};
    }
    Json operator()(const CylinderRoom& p) const {
      return {{"kind", "room"},
              {"base_mm", json_of(p.base_mm)},
              {"radius_mm", p.radius_mm},
              {"height_mm", p.height_mm}};
    }
  };
  Json json = std::visit(Of{}, named.patch);
  json["name"] = named.name;
  return json;
}

Json of_solid(const std::string& name, const Shape& shape, const RigidMotion& body_from_shape) {
  struct Of {
    Json operator()(const Box& s) const { return {{"shape", "box"}, {"size_mm", json_of(s.size_mm)}}; }
    Json operator()(const Capsule& s) const {
      return {{"shape", "capsule"},
              {"from_mm", json_of(s.from_mm)},
              {"to_mm", json_of(s.to_mm)},
              {"radius_mm", s.radius_mm}};
    }
    Json operator()(const Frustum& s) const {
      return {{"shape", "frustum"},
              {"bottom_radius_mm", s.bottom_radius_mm},
              {"top_radius_mm", s.top_radius_mm},
              {"height_mm", s.height_mm}};
    }
  };
  Json json = std::visit(Of{}, shape);
  json["name"] = name;
  json["pose"] = json_of_motion(body_from_shape);
  return json;
}

Json of_body_in_motion(const LayoutReport& report) {
  Json time = Json::array(), pose = Json::array();
  for (const Mover& mover : report.cell.movers) {
    if (mover.body.name != report.cell.layout->body) continue;
    for (const double time_s : report.pose_times_s) {
      time.push_back(decimals(time_s, 4));
      pose.push_back(json_of_motion(pose_at(mover.motion, time_s)));
    }
  }
  return {{"time_s", time}, {"pose", pose}};
}

/// By target a character a pose: 0 hidden, 1 left, 2 right, 3 both.
Json of_visibility(const LayoutDesign& design) {
  std::vector<std::string> seen(design.targets.size());
  for (const auto& [left, right] : design.visibility.seen) {
    for (std::size_t i = 0; i < seen.size(); ++i)
      seen[i] += static_cast<char>('0' + (left >> i & 1U) + 2 * (right >> i & 1U));
  }
  return seen;
}

Json of_errors(const ErrorOverMotion& error) {
  Json json = Json::array();
  for (const double mm : error.by_pose_mm) json.push_back(digits(mm, 4));
  return json;
}

bool is_objective(const LayoutDesign& design, const std::string& name) {
  return std::any_of(design.objectives.begin(), design.objectives.end(),
                     [&](const NamedValue& objective) { return objective.name == name; });
}

/// The columns: the objectives, the other quantities; then what the coordinates alone tell besides.
std::vector<std::size_t> columns_of(const LayoutDesign& design) {
  std::vector<std::size_t> columns(design.quantities.size());
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  std::stable_partition(columns.begin(), columns.end(),
                        [&](std::size_t i) { return is_objective(design, design.quantities[i].name); });
  return columns;
}

Json of_values(const LayoutDesign& design) {
  Json values = Json::array();
  for (const std::size_t i : columns_of(design)) {
    const std::optional<double>& value = design.quantities[i].value;
    values.push_back(value ? digits(*value, 6) : Json(nullptr));
  }
  const LayoutMetrics& metrics = design.metrics;
  for (const double mm : {metrics.max_radius_mm, metrics.symmetry_mm, metrics.enclosing_sphere.radius_mm})
    values.push_back(digits(mm, 6));
  return values;
}

Json of_measures(const LayoutDesign& design) {
  Json json = Json::array();
  for (const std::size_t i : columns_of(design)) {
    const NamedValue& quantity = design.quantities[i];
    json.push_back({{"name", quantity.name},
                    {"label", label_of_quantity(quantity.name)},
                    {"unit", quantity.unit},
                    {"better", quantity.more_is_better ? "more" : "less"},
                    {"objective", is_objective(design, quantity.name)}});
  }
  for (const auto& [name, label] : {std::pair{"max-radius", "largest distance to the centroid"},
                                    std::pair{"symmetry", "symmetry (s.d. of those distances)"},
                                    std::pair{"enclosing-radius", "radius of the enclosing sphere"}}) {
    json.push_back(
        {{"name", name}, {"label", label}, {"unit", "mm"}, {"better", "none"}, {"objective", false}});
  }
  return json;
}

Json of_layout(const LayoutDesign& design, bool given, const LayoutReport& report) {
  Json targets = Json::array();
  for (const Target& target : design.targets) targets.push_back(json_of_target(target));
  const auto& after = design.accuracy.after;
  return {{"name", design.name},
          {"origin", design.origin},
          {"reference", given},
          {"targets", targets},
          {"values", of_values(design)},
          {"fails", broken_constraints(design)},
          {"seen", of_visibility(design)},
          {"error_mm", after.empty() ? Json::array() : of_errors(after.front())},
          {"error_lost_mm", after.size() < 2 ? Json::array() : of_errors(after[1])},
          {"notes", notes_on(design, *report.cell.layout, report.pose_times_s)}};
}

Json of_history(const std::vector<GenerationRecord>& history) {
  Json json = Json::array();
  for (const GenerationRecord& record : history) {
    json.push_back({{"generation", record.generation},
                    {"evaluations", record.evaluations},
                    {"hypervolume", digits(record.hypervolume, 7)},
                    {"feasible_share", decimals(record.feasible_share, 4)},
                    {"seconds", decimals(record.seconds, 3)}});
  }
  return json;
}

}  // namespace

std::string layout_report_json(const LayoutReport& report) {
  require(report.cell.layout.has_value(), "a report about layouts is given the cell's layout task");
  require(report.knee < static_cast<int>(report.found.size()), "the knee is one of the layouts found");
  const LayoutTask& task = *report.cell.layout;
  Json layouts = Json::array(), patches = Json::array(), keep_outs = Json::array();
  Json obstacles = Json::array(), points = Json::array();
  for (const LayoutDesign& design : report.found) layouts.push_back(of_layout(design, false, report));
  for (const LayoutDesign& design : report.given) layouts.push_back(of_layout(design, true, report));
  for (const NamedPatch& patch : task.surface.patches) patches.push_back(of_patch(patch));
  for (const KeepOut& out : task.surface.keep_outs)
    keep_outs.push_back(of_solid(out.name, out.shape, out.body_from_shape));
  for (const Obstacle& obstacle : report.cell.obstacles) {
    if (obstacle.body == task.body)
      obstacles.push_back(of_solid(obstacle.name, obstacle.shape, obstacle.carrier_from_shape));
  }
  for (const WorkPoint& point : task.points)
    points.push_back({{"name", point.name}, {"position_mm", json_of(point.in_body_mm)}});
  const LayoutDesign* any = !report.found.empty()   ? &report.found.front()
                            : !report.given.empty() ? &report.given.front()
                                                    : nullptr;
  const Json json = {{"schema", "asterism-layout-report/1"},
                     {"title", report.title},
                     {"subtitle", report.subtitle},
                     {"summary", json_of_summary(report.summary)},
                     {"remarks", report.remarks},
                     {"body", task.body},
                     {"rig", json_of_rig(report.cell.rig)},
                     {"volume", json_of_volume(report.cell.volume, report.cell.rig)},
                     {"patches", patches},
                     {"keep_outs", keep_outs},
                     {"obstacles", obstacles},
                     {"points", points},
                     {"motion", of_body_in_motion(report)},
                     {"measures", any != nullptr ? of_measures(*any) : Json::array()},
                     {"layouts", layouts},
                     {"knee", report.knee >= 0 ? Json(report.knee) : Json(nullptr)},
                     {"why", report.why},
                     {"history", of_history(report.history)},
                     {"options", json_of_stored(report.options_json)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_layout_report(const std::filesystem::path& path, const LayoutReport& report) {
  write_file(path, page_with_data(report_page(), layout_report_json(report)));
}

}  // namespace asterism
