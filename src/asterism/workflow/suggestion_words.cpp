// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/suggestion_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

#include "asterism/report/layout_words.hpp"
#include "asterism/visibility/occlusion.hpp"

namespace asterism {
namespace {

/// All that tells whether and why a present target is seen.
struct Sights {
  const Cell& cell;
  const LayoutModel& model;
  const ObservedSights& observed;
  Occlusion solids;
  std::size_t carrier;
  MotionVisibility seen;  // by geometry and by what was observed

  Sights(const SuggestionSubject& subject, const LayoutModel& by)
      : cell(subject.cell),
        model(by),
        observed(subject.observed),
        solids(subject.cell),
        carrier(static_cast<std::size_t>(mover_index(cell, by.task.body))),
        seen(by.visibility_of(by.present)) {
    if (observed.unhidden.poses() > 0) seen = common(seen, observed.unhidden);
  }

  [[nodiscard]] bool both(std::size_t pose, std::size_t target) const {
    return (seen.both(pose) >> target & 1) != 0;
  }
};

std::string at_time(std::span<const double> times_s, std::size_t pose) {
  return pose < times_s.size() ? fmt::format("at {:.2f} s", times_s[pose]) : fmt::format("in pose {}", pose);
}

std::string point_name(const LayoutTask& task, std::size_t point) {
  return point < task.points.size() ? fmt::format("`{}`", task.points[point].name) : "the targets' centroid";
}

std::string worst_in_words(const LayoutModel& model, const Suggestion& suggestion,
                           std::span<const double> times_s) {
  const std::string label = label_of_quantity(info_of(suggestion.objective).name);
  const LayoutStanding& standing = suggestion.present;
  if (standing.undetermined > 0) {
    return fmt::format("{}: the pose is not determined in {} of {} poses", label, standing.undetermined,
                       model.motion.poses());
  }
  if (!standing.worst) return label + ": none";
  std::vector<std::string> lost;
  for (const std::size_t target : standing.worst->lost) lost.push_back(model.present[target].id);
  return fmt::format("{}: {} mm {}, at {}{}", label, text_of_value(standing.worst->mm),
                     at_time(times_s, standing.worst->pose), point_name(model.task, standing.worst->point),
                     lost.empty() ? "" : fmt::format(", when {} is lost", fmt::join(lost, " and ")));
}

/// Why not both cameras see a target in a pose.
std::string unseen_since(const Sights& sights, std::size_t target, std::size_t pose) {
  const LayoutModel& model = sights.model;
  for (const Side side : {Side::Left, Side::Right}) {
    const auto s = static_cast<std::size_t>(side);
    if ((sights.seen.seen[pose][s] >> target & 1) != 0) continue;
    const std::string camera = side == Side::Left ? "left" : "right";
    const auto geometry = look_at(model.present, model.motion.tracker_from_body[pose], model.motion.rig, side,
                                  model.volume, model.options.visibility);
    if (geometry[target].fails) return fmt::format("{} ({})", text_of(*geometry[target].fails), camera);
    const auto solid = sights.solids.hidden_by(model.present[target], sights.carrier,
                                               poses_at(sights.cell, model.times_s[pose]), side);
    if (solid) return fmt::format("hidden by {} ({})", sights.solids.names()[*solid], camera);
    return fmt::format("hidden, as observed ({})", camera);
  }
  return "seen";
}

std::string fewest_in_words(const Sights& sights, std::span<const double> times_s) {
  const TargetMask unsound = sights.observed.unsound;
  const std::vector<Target>& targets = sights.model.present;
  std::size_t worst = 0;
  const auto count = [&](std::size_t pose) { return std::popcount(sights.seen.both(pose) & ~unsound); };
  for (std::size_t pose = 1; pose < sights.seen.poses(); ++pose) {
    if (count(pose) < count(worst)) worst = pose;
  }
  std::vector<std::string> hidden;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if ((unsound >> i & 1) != 0) {
      hidden.push_back(targets[i].id + " not where the file has it");
    } else if (!sights.both(worst, i)) {
      hidden.push_back(targets[i].id + " " + unseen_since(sights, i, worst));
    }
  }
  return fmt::format("fewest seen by both cameras: {} of {}, {}{}", count(worst), targets.size(),
                     at_time(times_s, worst),
                     hidden.empty() ? "" : fmt::format(": {}", fmt::join(hidden, "; ")));
}

/// What hides a target in how many poses, most often first; a pose counts once, by the first camera that
/// misses the target.
std::vector<PresentTarget::Cause> causes_of(const Sights& sights, std::size_t target) {
  std::vector<PresentTarget::Cause> causes;
  const double one = 1.0 / static_cast<double>(sights.seen.poses());
  for (std::size_t pose = 0; pose < sights.seen.poses(); ++pose) {
    if (sights.both(pose, target)) continue;
    const std::string what = unseen_since(sights, target, pose);
    const auto same =
        std::find_if(causes.begin(), causes.end(), [&](const auto& cause) { return cause.what == what; });
    if (same == causes.end()) {
      causes.push_back({what, one});
    } else {
      same->share += one;
    }
  }
  std::stable_sort(causes.begin(), causes.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  return causes;
}

}  // namespace

std::vector<std::string> limits_in_words(const SuggestionSubject& subject, const LayoutModel& model,
                                         const Suggestion& suggestion, std::span<const double> pose_times_s) {
  std::vector<std::string> limits = {worst_in_words(model, suggestion, pose_times_s),
                                     fewest_in_words(Sights(subject, model), pose_times_s)};
  for (const std::string& broken : broken_constraints(suggestion.present.constraints))
    limits.push_back("✗ " + broken);
  return limits;
}

std::vector<PresentTarget> present_targets(const SuggestionSubject& subject, const LayoutModel& model,
                                           const Suggestion& suggestion) {
  const Sights sights(subject, model);
  std::vector<PresentTarget> targets;
  for (std::size_t i = 0; i < model.present.size(); ++i) {
    PresentTarget target;
    target.id = model.present[i].id;
    target.unseen_since = causes_of(sights, i);
    target.seen = 1;
    for (const auto& cause : target.unseen_since) target.seen -= cause.share;
    target.without = suggestion.without[i];
    if (!subject.targets.empty()) target.observed = subject.targets[i];
    targets.push_back(std::move(target));
  }
  return targets;
}

}  // namespace asterism
