// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/layout/change_bench.hpp"
#include "asterism/layout/change_search.hpp"

namespace asterism {
namespace {

using Q = LayoutQuantity;

constexpr double kSame = 1e-9;  // violations that differ by rounding alone

Q objective_of(const LayoutModel& model, const std::string& asked) {
  if (asked.empty()) {
    return model.task.losses == 0   ? Q::WorstError
           : model.task.losses == 1 ? Q::WorstErrorOneLost
                                    : Q::WorstErrorTwoLost;
  }
  const std::vector<Q> objectives = objectives_from(asked);
  const auto worst = [](Q q) {
    return q == Q::WorstError || q == Q::WorstErrorOneLost || q == Q::WorstErrorTwoLost;
  };
  if (objectives.size() == 1 && worst(objectives.front())) return objectives.front();
  throw InputError("objective", fmt::format("`{}` cannot be bettered target by target; one of worst-error, "
                                            "worst-error-1-lost, worst-error-2-lost can",
                                            asked));
}

void sort_by_worth(std::vector<LayoutChange>& changes) {
  std::stable_sort(changes.begin(), changes.end(),
                   [](const auto& a, const auto& b) { return better(a.after, b.after); });
}

/// The step from one place tried to the next.
double pitch_of(const std::vector<WatchedPlace>& places, const LayoutModel& model) {
  double area = 0;
  for (const NamedPatch& named : model.rules.surface.patches) area += area_mm2(named.patch);
  return std::sqrt(area / static_cast<double>(places.size()));
}

void count(Suggestion& suggestion, const ChangesFound& found) {
  suggestion.screened += found.screened;
  suggestion.evaluated += found.evaluated;
  suggestion.proven = suggestion.proven && found.proven;
}

/// Of each target the best place, and its own place beside it: what stands well needs but a nudge.
std::vector<LayoutChange> best_moves(const ChangeBench& bench, const std::vector<WatchedPlace>& places,
                                     const SuggestOptions& options, Suggestion& suggestion) {
  const LayoutModel& model = bench.model();
  std::vector<ChangesFound> found(bench.present().size());
  parallel_for(found.size(), [&](std::size_t i) {
    found[i] = best_places(bench, ChangeKind::Move, i, places, 1);
    const auto own =
        nearest_allowed_place(model.rules.surface, bench.present()[i].position, model.rules.clearance_mm);
    if (own && bench.free(own->position_mm, i)) {
      LayoutChange here = bench.changed(ChangeKind::Move, i, own);
      if (found[i].best.empty() || bench.prefers(here.after, found[i].best.front().after))
        found[i].best = {here};
    }
    for (LayoutChange& change : found[i].best)
      change = refined(bench, std::move(change), 0.5 * pitch_of(places, model), options.finest_mm);
  });
  std::vector<LayoutChange> moves;
  for (ChangesFound& one : found) {
    count(suggestion, one);
    std::move(one.best.begin(), one.best.end(), std::back_inserter(moves));
  }
  return moves;
}

std::vector<LayoutChange> best_additions(const ChangeBench& bench, const std::vector<WatchedPlace>& places,
                                         const SuggestOptions& options, Suggestion& suggestion) {
  const std::size_t next = bench.present().size();
  ChangesFound found =
      best_places(bench, ChangeKind::Add, next, places, static_cast<std::size_t>(options.alternatives));
  count(suggestion, found);
  std::vector<LayoutChange> additions(found.best.size());
  parallel_for(additions.size(), [&](std::size_t i) {
    additions[i] = refined(bench, found.best[i], 0.5 * pitch_of(places, bench.model()), options.finest_mm);
  });
  sort_by_worth(additions);
  std::vector<LayoutChange> apart;  // the fine search may have led two of them to one place
  for (LayoutChange& change : additions) {
    const bool free = std::none_of(apart.begin(), apart.end(), [&](const LayoutChange& other) {
      return (other.place->position_mm - change.place->position_mm).norm() < bench.model().rules.spacing_mm;
    });
    if (free) apart.push_back(std::move(change));
  }
  return apart;
}

std::vector<LayoutChange> each_present(const ChangeBench& bench, ChangeKind kind, TargetMask which,
                                       Suggestion& suggestion) {
  std::vector<LayoutChange> changes;
  for (std::size_t i = 0; i < bench.present().size(); ++i) {
    if ((which >> i & 1) == 0) continue;
    changes.push_back(bench.changed(kind, i));
    ++suggestion.evaluated;
  }
  return changes;
}

/// Two moves that are worth it together, where neither is alone.
void look_ahead(const ChangeBench& present, const std::vector<WatchedPlace>& places,
                const SuggestOptions& options, Suggestion& suggestion) {
  const std::vector<LayoutChange> firsts = best_moves(present, places, options, suggestion);
  std::vector<std::optional<LayoutChange>> seconds(firsts.size());
  std::vector<std::size_t> evaluated(firsts.size());
  parallel_for(firsts.size(), [&](std::size_t i) {
    const ChangeBench next = present.after(firsts[i]);
    for (std::size_t target = 0; target < present.present().size(); ++target) {
      if (target == firsts[i].target) continue;
      const ChangesFound found = best_places(next, ChangeKind::Move, target, places, 1);
      evaluated[i] += found.evaluated;
      if (found.best.empty()) continue;
      if (!seconds[i] || better(found.best.front().after, seconds[i]->after)) seconds[i] = found.best.front();
    }
  });
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    suggestion.evaluated += evaluated[i];
    if (seconds[i] && (!best || better(seconds[i]->after, seconds[*best]->after))) best = i;
  }
  if (!best || !worthwhile(suggestion.present, seconds[*best]->after, 2 * options.least_gain)) return;
  const ChangeBench next = present.after(firsts[*best]);
  suggestion.best = firsts[*best];
  suggestion.then =
      refined(next, *seconds[*best], 0.5 * pitch_of(places, present.model()), options.finest_mm);
}

/// What comes first: a measurement again costs least, a target more the most.
void choose(Suggestion& suggestion, std::size_t targets, double least_gain) {
  const LayoutStanding* standing = &suggestion.present;
  const auto n = static_cast<double>(targets);
  const auto consider = [&](const std::vector<LayoutChange>& changes, double gain) {
    if (changes.empty() || !worthwhile(*standing, changes.front().after, gain)) return;
    suggestion.best = changes.front();
    standing = &suggestion.best->after;
  };
  consider(suggestion.relearnings, least_gain);
  if (suggestion.best) return;  // it costs no hand at all, and changes what is best after it
  consider(suggestion.moves, least_gain);
  consider(suggestion.removals, least_gain);
  consider(suggestion.additions, least_gain + 1 - std::sqrt(n / (n + 1)));
}

void refuse_what_cannot_be_judged(const LayoutModel& model) {
  if (model.present.size() < 3) {
    throw MeasurementError(fmt::format(
        "body `{}` has {} target{}, too few for a pose that a change could better; `asterism layout "
        "optimize` finds whole layouts",
        model.task.body, model.present.size(), model.present.size() == 1 ? "" : "s"));
  }
  if (model.present.size() >= kMaxTargets) {
    throw MeasurementError(fmt::format("body `{}` has {} targets; up to {} can be judged", model.task.body,
                                       model.present.size(), kMaxTargets - 1));
  }
}

}  // namespace

double step_of_error(const std::optional<double>& mm) {
  return mm ? std::floor(std::log(*mm) / std::log(1.002)) : HUGE_VAL;
}

bool better(const LayoutStanding& a, const LayoutStanding& b) {
  if (std::abs(a.violation - b.violation) > kSame) return a.violation < b.violation;
  const double step_a = step_of_error(a.error_mm), step_b = step_of_error(b.error_mm);
  if (step_a != step_b) return step_a < step_b;
  return a.all_losses_mm.value_or(HUGE_VAL) < b.all_losses_mm.value_or(HUGE_VAL);
}

bool worthwhile(const LayoutStanding& from, const LayoutStanding& to, double least_gain) {
  if (std::abs(from.violation - to.violation) > kSame) return to.violation < from.violation;
  if (!to.error_mm) return false;
  return !from.error_mm || *to.error_mm < *from.error_mm * (1 - least_gain);
}

std::optional<double> gain_of(const LayoutStanding& from, const LayoutStanding& to) {
  if (!from.error_mm || !to.error_mm) return std::nullopt;
  return 1 - *to.error_mm / *from.error_mm;
}

Suggestion suggest_changes(const LayoutModel& model, const ObservedSights& observed,
                           const SuggestOptions& options) {
  refuse_what_cannot_be_judged(model);
  const std::vector<ChangeKind> kinds = kinds_from(options.kinds);
  const auto asked = [&](ChangeKind kind) {
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  };
  Suggestion suggestion;
  suggestion.objective = objective_of(model, options.objective);
  const ChangeBench bench(model, observed, suggestion.objective);
  suggestion.present = bench.standing();
  const std::size_t targets = model.present.size();
  const TargetMask all = (TargetMask{1} << targets) - 1;
  suggestion.relearnings = each_present(bench, ChangeKind::Relearn, observed.unsound & all, suggestion);
  std::vector<LayoutChange> removals = each_present(bench, ChangeKind::Remove, all, suggestion);
  for (const LayoutChange& removal : removals) suggestion.without.push_back(removal.after);

  std::vector<WatchedPlace> places;
  if (asked(ChangeKind::Move) || asked(ChangeKind::Add)) {
    places = watched_places(model, options.places);
    if (places.empty()) throw MeasurementError("the keep-outs leave no place on the surface");
    suggestion.places = places.size();
  }
  if (asked(ChangeKind::Move)) suggestion.moves = best_moves(bench, places, options, suggestion);
  if (asked(ChangeKind::Add)) {
    if (static_cast<int>(targets) < model.task.most) {
      suggestion.additions = best_additions(bench, places, options, suggestion);
      if (suggestion.additions.empty()) {
        suggestion.notes.push_back(fmt::format(
            "no target more has room on the surface, {} mm from the others", model.rules.spacing_mm));
      }
    } else {
      suggestion.notes.push_back(fmt::format("no target is added: the task allows {}", model.task.most));
    }
  }
  if (asked(ChangeKind::Remove)) {
    if (static_cast<int>(targets) > std::max(3, model.task.fewest)) {
      suggestion.removals = std::move(removals);
    } else {
      suggestion.notes.push_back(
          fmt::format("no target is taken away: the task wants {} or more", model.task.fewest));
    }
  }
  for (auto* changes :
       {&suggestion.relearnings, &suggestion.moves, &suggestion.additions, &suggestion.removals})
    sort_by_worth(*changes);
  for (auto* changes : {&suggestion.moves, &suggestion.additions}) {
    const std::size_t told = std::min(changes->size(), static_cast<std::size_t>(options.alternatives));
    for (std::size_t i = 0; i < told; ++i)
      (*changes)[i].nearby_mm = worst_nearby(bench, (*changes)[i], options.placing_mm);
  }
  choose(suggestion, targets, options.least_gain);
  if (!suggestion.best && asked(ChangeKind::Move)) {
    look_ahead(ChangeBench(model, observed, suggestion.objective, Foresight::OneMore), places, options,
               suggestion);
  }
  suggestion.stuck = !suggestion.best && suggestion.present.violation > kSame;
  return suggestion;
}

}  // namespace asterism
