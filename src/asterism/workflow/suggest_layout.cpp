// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/suggest_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/io/body_file.hpp"
#include "asterism/io/options_file.hpp"
#include "asterism/report/layout_words.hpp"
#include "asterism/workflow/suggestion_words.hpp"

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;

std::string coordinates(const Vec3& v) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

std::string what_is_done(const LayoutChange& change, const LayoutTask& task) {
  if (change.kind == ChangeKind::Remove) return fmt::format("Take {} away", change.id);
  if (change.kind == ChangeKind::Relearn) {
    return fmt::format("Leave {} where it is and learn anew where that is", change.id);
  }
  const std::string to = fmt::format("{} on `{}`", coordinates(change.place->position_mm),
                                     task.surface.patches[change.place->patch].name);
  return change.kind == ChangeKind::Add
             ? fmt::format("Add {} at {}", change.id, to)
             : fmt::format("Move {} to {}, {:.0f} mm away", change.id, to, change.way_mm);
}

std::string error_change(const LayoutStanding& from, const LayoutStanding& to) {
  if (!to.error_mm) return "not determined in some pose";
  std::string text =
      fmt::format("{} → {} mm", from.error_mm ? text_of_value(from.error_mm) : "not determined",
                  text_of_value(to.error_mm));
  if (const auto gain = gain_of(from, to)) text += fmt::format(" ({:+.0f} %)", -100 * *gain);
  return text;
}

/// Constraints that the change breaks, mends, or leaves broken.
std::string constraints_changed(const LayoutStanding& from, const LayoutStanding& to) {
  std::string text;
  for (std::size_t i = 0; i < to.constraints.size(); ++i) {
    const ConstraintState& before = from.constraints[i];
    const ConstraintState& after = to.constraints[i];
    if (before.violation == 0 && after.violation == 0) continue;
    const std::string broken = broken_constraints(std::span(&after, 1)).empty()
                                   ? ""
                                   : broken_constraints(std::span(&after, 1)).front();
    if (after.violation == 0) {
      text += fmt::format("; {} holds again", label_of_quantity(after.name));
    } else {
      text += fmt::format("; {}{}", before.violation == 0 ? "breaks: " : "still ", broken);
    }
  }
  return text;
}

std::string verdict_of(const SuggestedChange& suggested, const SuggestOptions& options) {
  const Suggestion& suggestion = suggested.suggestion;
  const LayoutTask& task = *suggested.cell.layout;
  if (suggestion.then) {
    return fmt::format("No single change gains more than {:.0f} %, but two moves together do. {}. Then {}",
                       100 * options.least_gain, in_words(*suggestion.best, suggestion, task),
                       in_words(*suggestion.then, suggestion, task));
  }
  if (suggestion.best) return in_words(*suggestion.best, suggestion, task);
  if (suggestion.stuck) {
    return fmt::format(
        "No single change mends what is broken ({}); `asterism layout optimize` searches for whole layouts",
        fmt::join(broken_constraints(suggestion.present.constraints), "; "));
  }
  return fmt::format("No change gains more than {:.0f} %: leave it", 100 * options.least_gain);
}

Json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json json_of(const LayoutStanding& standing) {
  Json json = {{"error_mm", standing.error_mm ? Json(*standing.error_mm) : Json(nullptr)},
               {"all_losses_mm", standing.all_losses_mm ? Json(*standing.all_losses_mm) : Json(nullptr)},
               {"undetermined_poses", standing.undetermined},
               {"visible", standing.visible},
               {"breaks", broken_constraints(standing.constraints)},
               {"constraints", Json::array()}};
  for (const ConstraintState& one : standing.constraints) {
    json["constraints"].push_back({{"name", one.name},
                                   {one.at_least ? "at_least" : "at_most", one.bound},
                                   {"value", one.value ? Json(*one.value) : Json(nullptr)},
                                   {"holds", one.violation == 0}});
  }
  return json;
}

Json json_of(const ObservedTarget& target) {
  Json json = {{"seen_left", target.seen[0]},
               {"seen_right", target.seen[1]},
               {"seen_by_both", target.seen_by_both},
               {"sigma_px", target.sigma_px ? Json(*target.sigma_px) : Json(nullptr)},
               {"noisy", target.noisy},
               {"displaced", nullptr}};
  if (target.displaced) {
    const Displacement& off = *target.displaced;
    json["displaced"] = {{"mm", json_of(off.mm)},
                         {"sigma_mm", json_of(off.sigma_mm)},
                         {"since_s", off.since_s ? Json(*off.since_s) : Json(nullptr)},
                         {"frames", off.frames}};
  }
  return json;
}

Json json_of(const PresentTarget& target) {
  Json json = {{"id", target.id}, {"seen_by_both", target.seen}, {"unseen_since", Json::array()}};
  for (const auto& cause : target.unseen_since)
    json["unseen_since"].push_back({{"what", cause.what}, {"share", cause.share}});
  json["without"] = json_of(target.without);
  json["observed"] = target.observed ? json_of(*target.observed) : Json(nullptr);
  return json;
}

Json json_of(const LayoutChange& change, const Suggestion& suggestion, const LayoutTask& task) {
  Json json = {
      {"kind", text_of(change.kind)}, {"target", change.id}, {"words", in_words(change, suggestion, task)}};
  if (change.place) {
    json["position_mm"] = json_of(change.place->position_mm);
    json["normal"] = json_of(change.place->normal);
    json["patch"] = task.surface.patches[change.place->patch].name;
    json["way_mm"] = change.way_mm;
    json["nearby_mm"] = change.nearby_mm ? Json(*change.nearby_mm) : Json(nullptr);
  }
  const auto gain = gain_of(suggestion.present, change.after);
  json["gain"] = gain ? Json(*gain) : Json(nullptr);
  json["after"] = json_of(change.after);
  return json;
}

}  // namespace

std::string in_words(const LayoutChange& change, const Suggestion& suggestion, const LayoutTask& task) {
  const LayoutStanding& from = suggestion.present;
  const LayoutStanding& to = change.after;
  std::string text =
      fmt::format("{}: {} {}", what_is_done(change, task),
                  label_of_quantity(info_of(suggestion.objective).name), error_change(from, to));
  if (from.visible != to.visible) text += fmt::format(", least visible {} → {}", from.visible, to.visible);
  return text + constraints_changed(from, to);
}

SuggestedChange suggest_layout(const SuggestionSubject& subject, const SuggestOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  LayoutModel model(subject.cell, designer_options(options));
  model.present = model.completed(model.present);
  SuggestedChange suggested;
  suggested.cell = subject.cell;
  suggested.pose_times_s = subject.pose_times_s.empty() ? model.times_s : subject.pose_times_s;
  suggested.suggestion = suggest_changes(model, subject.observed, options);
  suggested.limits = limits_in_words(subject, model, suggested.suggestion, suggested.pose_times_s);
  suggested.targets = present_targets(subject, model, suggested.suggestion);
  suggested.observations = subject.observations;
  suggested.warnings = subject.warnings;
  suggested.verdict = verdict_of(suggested, options);
  suggested.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return suggested;
}

Json json_of(const SuggestedChange& suggested, const SuggestOptions& options) {
  const Suggestion& suggestion = suggested.suggestion;
  const LayoutTask& task = *suggested.cell.layout;
  Json json = {{"cell", suggested.cell.name},
               {"body", task.body},
               {"verdict", suggested.verdict},
               {"objective", info_of(suggestion.objective).name},
               {"observations", suggested.observations},
               {"limits", suggested.limits},
               {"targets", Json::array()},
               {"present", json_of(suggestion.present)},
               {"best", suggestion.best ? json_of(*suggestion.best, suggestion, task) : Json(nullptr)}};
  for (const PresentTarget& target : suggested.targets) json["targets"].push_back(json_of(target));
  json["then"] = suggestion.then ? json_of(*suggestion.then, suggestion, task) : Json(nullptr);
  const auto list = [&](const std::string& name, const std::vector<LayoutChange>& changes) {
    json[name] = Json::array();
    for (const LayoutChange& change : changes) json[name].push_back(json_of(change, suggestion, task));
  };
  list("relearn", suggestion.relearnings);
  list("move", suggestion.moves);
  list("add", suggestion.additions);
  list("remove", suggestion.removals);
  json["not_tried"] = suggestion.notes;
  json["places"] = suggestion.places;
  json["screened"] = suggestion.screened;
  json["evaluated"] = suggestion.evaluated;
  json["proven"] = suggestion.proven;
  json["warnings"] = suggested.warnings;
  json["seconds"] = suggested.seconds;
  SuggestOptions shown = options;
  json["options"] = json_of_options(describing(shown));
  return json;
}

void write_suggestion(const std::filesystem::path& out, const SuggestedChange& suggested,
                      const SuggestOptions& options) {
  if (suggested.suggestion.best) {
    std::vector<Body> bodies = bodies_of(suggested.cell);
    for (Body& body : bodies) {
      if (body.name == suggested.cell.layout->body) body.targets = suggested.suggestion.best->targets;
    }
    write_bodies(out / "bodies.toml", bodies);
  }
  write_file(out / "suggestion.json", json_of(suggested, options).dump(2) + "\n");
}

}  // namespace asterism
