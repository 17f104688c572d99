// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "asterism/layout/design.hpp"
#include "asterism/layout/layout_model.hpp"

namespace asterism {

// Which single target to move, add or remove next: for a cell that stands and is watched, where a whole new
// layout is more than anyone wants to drill.

struct SuggestOptions {
  std::string kinds = "move, add, remove";
  std::string objective;     // what to better: a worst error; empty: that after the task's losses
  std::string constraints;   // as DesignerOptions has them
  int places = 800;          // of the surface, each tried for each target
  int alternatives = 3;      // told of each kind
  double least_gain = 0.03;  // share of the error; what gains less is not worth the hand
  double finest_mm = 1;      // to which the best places are sought along the surface
  double placing_mm = 10;    // how far beside its place a foot may come to stand
  VisibilityOptions visibility;
  AccuracyOptions accuracy;
};
void describe(SuggestOptions& options, OptionVisitor& visit);

/// The designer's options that ask a LayoutModel the same question.
[[nodiscard]] DesignerOptions designer_options(const SuggestOptions& options);

/// What watching the present targets taught beyond geometry, pose by pose of the model's motion.
struct ObservedSights {
  MotionVisibility unhidden;  // bit i cleared: target i was hidden there; no poses: nothing was observed
  TargetMask unsound = 0;     // targets that do not stand where the body's file has them: poses do without
  std::map<std::size_t, Target> found;  // of those, where they were found to stand
};

/// Relearn: leave the target where it is and learn its coordinates anew.
enum class ChangeKind { Relearn, Move, Add, Remove };
[[nodiscard]] std::string text_of(ChangeKind kind);
/// "move, add" → kinds. Throws InputError for an unknown word, one given twice and for none.
[[nodiscard]] std::vector<ChangeKind> kinds_from(const std::string& text);

/// How a layout stands in the task: first what is broken, then the error.
struct LayoutStanding {
  std::optional<double> error_mm;  // the objective; none where a pose is not determined, maybe after losses
  std::optional<double> all_losses_mm;  // (Σ E⁸)^(1/8) over the losses, E being the worst error after each
  std::size_t undetermined = 0;         // poses that are not, maybe after losses
  int visible = 0;                      // fewest targets that both cameras see
  std::vector<ConstraintState> constraints;
  double violation = 0;  // all that is broken, each by its scale; 0 = nothing is
  std::optional<WorstError> worst;
};
/// Errors within 0.2 % of one another are one; the step of a ladder on which an error stands.
[[nodiscard]] double step_of_error(const std::optional<double>& mm);
/// Less broken; or as much and with the smaller error; or, on the same step, with the smaller error over
/// all losses together. Where a target is moved, the loss of itself is often the worst that can happen, and
/// then all its places are alike in that; the last rule takes the one that helps the next change most.
[[nodiscard]] bool better(const LayoutStanding& a, const LayoutStanding& b);
/// Better, and by so much that it is worth a hand: something is mended, or the error falls by the share.
[[nodiscard]] bool worthwhile(const LayoutStanding& from, const LayoutStanding& to, double least_gain);
/// Share by which the error falls; none where one of them has no value.
[[nodiscard]] std::optional<double> gain_of(const LayoutStanding& from, const LayoutStanding& to);

struct LayoutChange {
  ChangeKind kind = ChangeKind::Move;
  std::size_t target = 0;  // of the present ones; of an addition their number
  std::string id;
  std::optional<Place> place;   // where it goes; none for a removal
  double way_mm = 0;            // from where it stood; of a move
  std::vector<Target> targets;  // the layout after it, the others untouched
  LayoutStanding after;
  std::optional<double> nearby_mm;  // largest error where the foot stands `placing_mm` beside the place; none
                                    // when that breaks something
};

/// Of each kind the changes by what they are worth, best first: of moves the best of each target, of
/// additions places a spacing apart.
struct Suggestion {
  LayoutQuantity objective = LayoutQuantity::WorstErrorOneLost;
  LayoutStanding present;
  std::vector<LayoutStanding> without;  // each of the present targets: what it is worth
  std::vector<LayoutChange> relearnings, moves, additions, removals;
  std::optional<LayoutChange> best;  // what to do next; none: leave it as it is
  std::optional<LayoutChange>
      then;            // where the best alone gains too little: the move that it makes worth while
  bool stuck = false;  // something is broken and no change mends any of it
  std::vector<std::string> notes;  // kinds that were not tried, and why
  std::size_t places = 0;          // tried for each target
  std::size_t screened = 0;        // changes that a lower bound of their error was taken of
  std::size_t evaluated = 0;       // changes that were evaluated in full
  bool proven = true;              // over those places nothing better exists (before the fine search)
};

/// Every place of the surface for every target, by branch and bound: a change's error over a few hard poses
/// is a lower bound of its error over all, so that only the promising ones are evaluated in full; the best
/// then go along the surface to the nearest millimetre. Where no change is worth it, two moves together are
/// asked: of each target the move that helps most against all losses together, then the best of another. An
/// addition comes first only when it gains more than a measurement more does by itself (1 − √(n/(n+1)))
/// beyond what a move gains. Throws MeasurementError when the body has fewer than three targets or the
/// surface no free place.
[[nodiscard]] Suggestion suggest_changes(const LayoutModel& model, const ObservedSights& observed,
                                         const SuggestOptions& options);

}  // namespace asterism
