// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "asterism/evaluation/pose_errors.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/options_file.hpp"
#include "asterism/workflow/verify_cell.hpp"

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json json_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(const NeesAgreement& nees) {
  return {{"poses", nees.poses},
          {"mean", nees.mean},
          {"mean_over_six", nees.mean / 6},
          {"band", {nees.band.low, nees.band.high}},
          {"in_band", nees.honest()}};
}

Json json_of(const AccuracyAgreement& agreement) {
  Json json = {{"points", Json::array()},
               {"nees_predicted", json_of(agreement.predicted)},
               {"nees_stated", json_of(agreement.stated)},
               {"frames_outside", agreement.outside},
               {"frames_missed", agreement.missed},
               {"frames_unpredicted", agreement.unpredicted},
               {"frames_other_targets", agreement.other_targets},
               {"wrong", agreement.wrong}};
  for (const PointAgreement& point : agreement.points) {
    json["points"].push_back({{"point", point.point},
                              {"simulated_mm", point.simulated_mm},
                              {"predicted_mm", point.predicted_mm},
                              {"ratio", point.ratio()}});
  }
  return json;
}

Json json_of(const Summary& summary, const Interval& interval) {
  return {{"runs", summary.count},
          {"mean", summary.mean},
          {"deviation", summary.deviation},
          {"max", summary.highest},
          {"interval_95", {interval.low, interval.high}}};
}

Json json_of(const LayoutComparison& comparison) {
  Json json = {{"quantity", std::string(text_of(comparison.quantity))},
               {"unit", comparison.quantity == RunQuantity::RotationDeg ? "deg" : "mm"},
               {"at_rest", comparison.at_rest},
               {"runs", comparison.runs},
               {"layouts", Json::array()},
               {"pairs", Json::array()}};
  for (const SampleOfLayout& layout : comparison.layouts) {
    json["layouts"].push_back({{"name", layout.name},
                               {"first", json_of(layout.first, layout.first_interval)},
                               {"all", json_of(layout.all, layout.all_interval)}});
  }
  for (const PairOfLayouts& pair : comparison.pairs) {
    json["pairs"].push_back({{"a", comparison.layouts[pair.a].name},
                             {"b", comparison.layouts[pair.b].name},
                             {"first_p_holm", pair.first_p_holm},
                             {"all_difference", pair.all.difference},
                             {"all_p_holm", pair.all_p_holm},
                             {"power_of_first", pair.power_of_first},
                             {"runs_for_80_percent", json_or_null(pair.runs_needed)}});
  }
  return json;
}

Json json_of_budget(const VerifiedCell& verified) {
  const ErrorBudget& budget = verified.budget;
  Json json = {{"point", verified.body.points[verified.worst.point].name},
               {"frame", verified.worst.frame},
               {"time_s", verified.watched.times_s[verified.worst.frame]},
               {"rms_mm", budget.rms_mm},
               {"below_95_mm", budget.below_95_mm},
               {"shares", Json::array()},
               {"first_order_mm", budget.first.uncertainty},
               {"drawn_mm", budget.drawn.uncertainty},
               {"draws", budget.drawn.trials},
               {"draws_stable", budget.drawn.stable},
               {"first_order_valid", budget.check.valid}};
  for (const BudgetShare& share : budget.shares) {
    json["shares"].push_back({{"source", std::string(text_of(share.source))},
                              {"sigma_mm", share.sigma_mm},
                              {"bias_mm", share.bias_mm.norm()},
                              {"share", share.share}});
  }
  return json;
}

Json json_of(const ErrorSummary& errors) {
  return {{"mean", errors.mean}, {"rms", errors.rms}, {"p95", errors.p95}, {"max", errors.max}};
}

Json json_of(const RobustnessTable& robustness) {
  Json json = Json::array();
  for (const FaultOutcome& fault : robustness.rows) {
    const Outcome& outcome = fault.measured;
    json.push_back({{"fault", fault.fault},
                    {"runs", fault.runs},
                    {"frames", outcome.frames},
                    {"kept", outcome.kept},
                    {"rough", outcome.rough},
                    {"flagged", outcome.flagged},
                    {"lost", outcome.lost},
                    {"too_sure", outcome.too_sure},
                    {"wrong", outcome.wrong},
                    {"rms_mm", outcome.seen > 0 ? Json(outcome.rms_mm()) : Json(nullptr)},
                    {"knocks", fault.knocks},
                    {"knocked_found", fault.found},
                    {"knocked_undecided", fault.undecided},
                    {"accused_wrong", fault.accused_wrong},
                    {"worst", fault.worst}});
  }
  return json;
}

Json json_of(const FusionRoad& road) {
  return {{"frames", road.frames}, {"lost", road.lost},           {"rms_mm", road.rms_mm},
          {"p95_mm", road.p95_mm}, {"stated_mm", road.stated_mm}, {"nees_over_six", road.nees / 6}};
}

Json json_of(const FusionStudy& fusion) {
  Json json = {{"point", fusion.point}, {"runs", fusion.runs}, {"occlusions", Json::array()}};
  for (const FusionSpell& spell : fusion.spells) {
    json["occlusions"].push_back({{"occlusion_s", spell.occlusion_s},
                                  {"alone", json_of(spell.alone)},
                                  {"with_read_out", json_of(spell.with_read_out)}});
  }
  const FusionOffset& offset = fusion.offset;
  json["time_offset"] = {{"told", offset.told},
                         {"true_s", offset.true_s},
                         {"mean_s", offset.mean_s},
                         {"sigma_s", offset.sigma_s},
                         {"rms_in_sigma", offset.rms_in_sigma}};
  return json;
}

/// Empty where there is no number.
std::string cell_of_number(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

}  // namespace

Json summary_of(const VerifiedCell& verified, const VerifyOptions& options) {
  const auto& visibility = verified.watched.bodies[verified.body.mover].visibility;
  const std::vector<int> visible = visible_counts(visibility);
  Json json = {{"cell", verified.cell},
               {"body", verified.body_name},
               {"frames", verified.watched.times_s.size()},
               {"verdict",
                {{"pass", verified.verdict.pass},
                 {"words", verified.verdict.words},
                 {"tolerance_mm", verified.tolerance_mm},
                 {"nominal_mm", verified.nominal_mm},
                 {"below_95_mm", verified.verdict.below_95_mm},
                 {"beyond", verified.verdict.beyond},
                 {"largest_mm", verified.verdict.largest_mm}}},
               {"visible",
                {{"fewest", *std::min_element(visible.begin(), visible.end())},
                 {"most", *std::max_element(visible.begin(), visible.end())}}},
               {"undetermined_frames", verified.predicted.undetermined},
               {"repeats", verified.repeats}};
  for (std::size_t i = 0; i < verified.status.size(); ++i)
    json["status"][std::string(text_of(static_cast<PoseStatus>(i)))] = verified.status[i];
  json["noise"] = json_of(verified.noise_agreement);
  json["all_sources"] = json_of(verified.agreement);
  json["budget"] = json_of_budget(verified);
  if (verified.read_out) {
    json["without_targets"] = {{"rotation_deg", json_of(summary_of(verified.read_out->rotation_deg))},
                               {"translation_mm", json_of(summary_of(verified.read_out->translation_mm))}};
  }
  if (verified.map) {
    json["error_map"] = {{"vertices", verified.map->error_mm.size()},
                         {"worst_vertex", verified.map->worst},
                         {"worst_mm", verified.map->error_mm[verified.map->worst]}};
  }
  for (const LayoutComparison& comparison : verified.comparisons)
    json["disturbance"].push_back(json_of(comparison));
  if (verified.robustness) json["faults"] = json_of(*verified.robustness);
  if (verified.fusion) json["fusion"] = json_of(*verified.fusion);
  for (const auto& [stage, seconds] : verified.seconds) json["seconds"][stage] = seconds;
  VerifyOptions shown = options;
  json["options"] = json_of_options(describing(shown));
  return json;
}

std::string errors_csv(const VerifiedCell& verified) {
  std::string text =
      "frame,time_s,point,status,targets_visible,targets_used,predicted_mm,measured_mm,read_out_mm\n";
  for (std::size_t frame = 0; frame < verified.watched.times_s.size(); ++frame) {
    const SimulatedPose& pose = verified.poses[frame];
    for (std::size_t i = 0; i < verified.body.points.size(); ++i) {
      const WorkPoint& point = verified.body.points[i];
      std::optional<double> measured, read_out;
      if (pose.error) measured = error_at(pose, point.in_body_mm).norm();
      if (verified.read_out) read_out = verified.read_out->at_mm[i][frame];
      text += fmt::format("{},{:.6f},{},{},{},{},{},{},{}\n", frame, verified.watched.times_s[frame],
                          csv_cell(point.name), text_of(pose.status), visible_at(verified, frame),
                          pose.targets, cell_of_number(verified.predicted.points[i].error_mm(frame)),
                          cell_of_number(measured), cell_of_number(read_out));
    }
  }
  return text;
}

std::string sights_csv(const Cell& cell, const VerifiedCell& verified) {
  std::string text = "frame,time_s,body,target,camera,seen,reason,hidden_by\n";
  for (std::size_t frame = 0; frame < verified.watched.times_s.size(); ++frame) {
    for (std::size_t mover = 0; mover < cell.movers.size(); ++mover) {
      const Body& body = cell.movers[mover].body;
      for (std::size_t target = 0; target < body.targets.size(); ++target) {
        for (std::size_t side = 0; side < 2; ++side) {
          const SightCause& cause = verified.watched.bodies[mover].causes[frame][target][side];
          text += fmt::format("{},{:.6f},{},{},{},{},{},{}\n", frame, verified.watched.times_s[frame],
                              csv_cell(body.name), csv_cell(body.targets[target].id),
                              side == 0 ? "left" : "right", cause.seen() ? 1 : 0,
                              cause.fails ? csv_cell(std::string(text_of(*cause.fails))) : "",
                              cause.solid ? csv_cell(verified.solids[*cause.solid]) : "");
        }
      }
    }
  }
  return text;
}

}  // namespace asterism
