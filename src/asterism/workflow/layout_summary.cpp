// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/io/options_file.hpp"
#include "asterism/report/layout_words.hpp"
#include "asterism/workflow/design_layout.hpp"

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;

Json of_value(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json of_quantities(const std::vector<NamedValue>& quantities) {
  Json json;
  for (const NamedValue& quantity : quantities) json[quantity.name] = of_value(quantity.value);
  return json;
}

Json of_constraints(const std::vector<ConstraintState>& constraints) {
  Json json = Json::array();
  for (const ConstraintState& state : constraints) {
    json.push_back({{"name", state.name},
                    {"unit", state.unit},
                    {state.at_least ? "at_least" : "at_most", state.bound},
                    {"value", of_value(state.value)},
                    {"violation", of_value(state.violation)}});
  }
  return json;
}

Json of_targets(const std::vector<Target>& targets) {
  Json json = Json::array();
  for (const Target& target : targets) {
    Json one = {{"id", target.id},
                {"position_mm", {target.position.x(), target.position.y(), target.position.z()}}};
    if (target.normal) one["normal"] = {target.normal->x(), target.normal->y(), target.normal->z()};
    if (target.diameter_mm) one["diameter_mm"] = *target.diameter_mm;
    json.push_back(one);
  }
  return json;
}

}  // namespace

Json json_of_design(const LayoutDesign& design) {
  return {{"name", design.name},
          {"origin", design.origin},
          {"feasible", design.feasible()},
          {"breaks", broken_constraints(design)},
          {"quantities", of_quantities(design.quantities)},
          {"constraints", of_constraints(design.constraints)},
          {"targets", of_targets(design.targets)}};
}

Json summary_of(const DesignedLayouts& designed, const Cell& cell, const DesignerOptions& options) {
  const DesignResult& result = designed.result;
  Json json = {{"cell", cell.name},
               {"body", cell.layout->body},
               {"front_found", result.front_found},
               {"front_told", result.front.size()},
               {"front_checksum", fmt::format("{:016x}", result.front_checksum)},
               {"knee", result.knee >= 0 ? Json(result.knee + 1) : Json(nullptr)},
               {"why", result.why},
               {"infeasible", result.infeasible},
               {"warnings", result.warnings},
               {"generations", result.history.empty() ? 0 : result.history.back().generation},
               {"evaluations", designed.evaluations},
               {"hypervolume", result.history.empty() ? 0 : result.history.back().hypervolume},
               {"feasible_share", result.history.empty() ? 0 : result.history.back().feasible_share},
               {"ended", designed.stopped || !result.stopped ? "stopped" : words(*result.stopped)},
               {"searching_s", designed.searching_s},
               {"front", Json::array()},
               {"given", Json::array()},
               {"greedy", Json::array()}};
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    Json one = json_of_design(result.front[i]);
    one["layout"] = i + 1;
    one["given_up"] = result.given_up[i];
    json["front"].push_back(one);
  }
  if (result.present) json["given"].push_back(json_of_design(*result.present));
  for (const LayoutDesign& design : result.published) json["given"].push_back(json_of_design(design));
  for (const GreedyDesign& greedy : result.greedy) {
    json["greedy"].push_back({{"targets", greedy.design.targets.size()},
                              {"gain", greedy.gain},
                              {"upper_bound", greedy.upper_bound},
                              {"guaranteed", greedy.guaranteed},
                              {"places", greedy.places},
                              {"quantities", of_quantities(greedy.design.quantities)}});
  }
  if (result.closest) json["closest"] = json_of_design(*result.closest);
  DesignerOptions shown = options;
  json["options"] = json_of_options(describing(shown));
  return json;
}

}  // namespace asterism
