// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/change_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/visibility/availability.hpp"

namespace asterism {
namespace {

using Q = LayoutQuantity;

// A layout none of whose poses is determined misses as much as ten targets that are not seen.
constexpr double kAllUndetermined = 10;
constexpr double kPower = 8;

TargetMask bit(std::size_t target) { return TargetMask{1} << target; }

/// What hides the present targets, in the order of the layout after a change. A target in a new place starts
/// unhidden: what was observed tells of the old one only.
TargetMask after_change(TargetMask unhidden, TargetMask unsound, ChangeKind kind, std::size_t target) {
  const TargetMask sound = unhidden & ~unsound;
  switch (kind) {
    case ChangeKind::Relearn:
      return sound | (unhidden & bit(target));
    case ChangeKind::Move:
      return sound | bit(target);
    case ChangeKind::Add:
      return sound | bit(target);
    case ChangeKind::Remove:
      break;
  }
  const TargetMask before = sound & (bit(target) - 1);
  const TargetMask behind = target + 1 < kMaxTargets ? (sound >> (target + 1)) << target : 0;
  return before | behind;
}

MotionVisibility all_unhidden(std::size_t poses) {
  return {std::vector<std::array<TargetMask, 2>>(poses, {~TargetMask{0}, ~TargetMask{0}})};
}

/// "P7": the first number that no target has, with the letters of the first target.
std::string free_id(const std::vector<Target>& targets) {
  std::string letters = targets.empty() ? "P" : targets.front().id;
  while (!letters.empty() && letters.back() >= '0' && letters.back() <= '9') letters.pop_back();
  for (std::size_t number = targets.size() + 1;; ++number) {
    const std::string id = fmt::format("{}{}", letters, number);
    if (std::none_of(targets.begin(), targets.end(), [&](const Target& t) { return t.id == id; })) return id;
  }
}

/// As well as the others are known, on average and in every direction: once it stands it is learnt as they.
std::optional<Mat3> usual_covariance(const std::vector<Target>& targets) {
  double variance = 0;
  int known = 0;
  for (const Target& target : targets) {
    if (!target.covariance) continue;
    variance += target.covariance->trace() / 3;
    ++known;
  }
  if (known == 0) return std::nullopt;
  return Mat3(Mat3::Identity() * (variance / known));
}

/// Adds powers over the ways to lose so many of the targets from `first` on; the worst error of each.
void add_losses(std::vector<Target>& left, MotionVisibility& seen, std::size_t first, std::size_t losses,
                const SeenMotion& motion, const LayoutModel& model, double& sum, bool& determined) {
  if (losses == 0) {
    AccuracyOptions accuracy = model.options.accuracy;
    accuracy.losses = 0;
    const MotionAccuracy known = predict_accuracy(left, motion, seen, model.points, accuracy);
    const ErrorOverMotion& error = known.nominal();
    determined = determined && error.undetermined == 0 && error.worst;
    if (determined) sum += std::pow(error.worst->mm, kPower);
    return;
  }
  for (std::size_t i = first; i < left.size() && determined; ++i) {
    MotionVisibility without = seen;
    for (auto& pose : without.seen) {
      for (TargetMask& side : pose) side &= ~bit(i);
    }
    add_losses(left, without, i + 1, losses - 1, motion, model, sum, determined);
  }
}

}  // namespace

std::optional<double> error_over_losses(std::span<const Target> targets, const SeenMotion& motion,
                                        const MotionVisibility& seen, const LayoutModel& model,
                                        std::size_t losses) {
  std::vector<Target> all(targets.begin(), targets.end());
  MotionVisibility left = seen;
  double sum = 0;
  bool determined = true;
  add_losses(all, left, 0, losses, motion, model, sum, determined);
  return determined ? std::optional(std::pow(sum, 1 / kPower)) : std::nullopt;
}

ChangeBench::ChangeBench(const LayoutModel& model, ObservedSights observed, LayoutQuantity objective,
                         Foresight foresight)
    : model_(model),
      present_(model.present),
      observed_(std::move(observed)),
      objective_(objective),
      foresight_(foresight) {
  require(observed_.unhidden.poses() == 0 || observed_.unhidden.poses() == model.motion.poses(),
          "what was observed is of the model's poses");
  wanted_[static_cast<std::size_t>(objective)] = true;
  for (const LayoutConstraint& constraint : model.constraints) {
    wanted_[static_cast<std::size_t>(constraint.quantity)] = true;
  }
}

ChangeBench ChangeBench::after(const LayoutChange& change) const {
  require(change.kind != ChangeKind::Relearn, "a target learnt anew is another file, not another layout");
  ChangeBench next = *this;
  next.foresight_ = Foresight::None;
  next.present_ = change.targets;
  for (auto& pose : next.observed_.unhidden.seen) {
    for (TargetMask& side : pose) side = after_change(side, 0, change.kind, change.target);
  }
  next.observed_.unsound = after_change(observed_.unsound, 0, change.kind, change.target);
  if (change.kind == ChangeKind::Move || change.kind == ChangeKind::Add)
    next.observed_.unsound &= ~bit(change.target);  // what is in a new place is learnt there
  next.observed_.found.clear();
  return next;
}

bool ChangeBench::prefers(const LayoutStanding& a, const LayoutStanding& b) const {
  constexpr double kSame = 1e-9;  // by rounding alone
  if (foresight_ == Foresight::None || std::abs(a.violation - b.violation) > kSame) return better(a, b);
  return a.all_losses_mm.value_or(HUGE_VAL) < b.all_losses_mm.value_or(HUGE_VAL);
}

std::size_t ChangeBench::losses() const {
  return (static_cast<std::size_t>(objective_) - static_cast<std::size_t>(Q::WorstError)) / 2;
}

MotionVisibility ChangeBench::relied_on() const {
  MotionVisibility relied =
      observed_.unhidden.poses() > 0 ? observed_.unhidden : all_unhidden(model_.motion.poses());
  for (auto& pose : relied.seen) {
    for (TargetMask& side : pose) side &= ~observed_.unsound;
  }
  return relied;
}

double ChangeBench::missing_visible(const MotionVisibility& seen) const {
  double needed = 4;
  for (const LayoutConstraint& constraint : model_.constraints) {
    if (constraint.quantity == Q::Visible) needed = std::max(needed, constraint.bound);
  }
  double worst = 0, sum = 0;
  for (const int visible : visible_counts(seen)) {
    const double missing = std::max(0.0, needed - visible);
    worst = std::max(worst, missing);
    sum += missing;
  }
  return worst + sum / static_cast<double>(seen.poses());
}

double ChangeBench::undetermined_violation(std::size_t poses) const {
  return kAllUndetermined * static_cast<double>(poses) / static_cast<double>(model_.motion.poses());
}

LayoutStanding ChangeBench::standing_of(std::span<const Target> targets, const MotionVisibility& unhidden,
                                        double cap_mm) const {
  const LayoutValues values =
      model_.values(targets, common(model_.visibility_of(targets), unhidden), wanted_, cap_mm);
  LayoutStanding standing;
  standing.error_mm = values[objective_];
  standing.visible = fewest_visible(values.visibility);
  const ErrorOverMotion& after = values.accuracy.after[losses()];
  standing.undetermined = after.undetermined;
  standing.all_losses_mm = error_over_losses(targets, model_.motion, values.visibility, model_, losses());
  standing.worst = after.worst;
  standing.violation = undetermined_violation(after.undetermined) + missing_visible(values.visibility);
  for (const LayoutConstraint& constraint : model_.constraints) {
    standing.constraints.push_back(state_of(constraint, values[constraint.quantity]));
    if (constraint.quantity == Q::Visible) continue;  // told by missing_visible, finer
    standing.violation += standing.constraints.back().violation / info_of(constraint.quantity).scale;
  }
  return standing;
}

LayoutStanding ChangeBench::standing() const {
  const double cap = std::max(model_.options.identifiability_cap_mm, model_.bound_on(Q::Identifiability));
  return standing_of(present(), relied_on(), cap);
}

Target ChangeBench::placed(std::size_t target, const Place& place) const {
  Target placed;
  placed.id = target < present().size() ? present()[target].id : free_id(present());
  placed.position = place.position_mm;
  placed.normal = place.normal;
  placed.diameter_mm = target < present().size() ? present()[target].diameter_mm : model_.task.diameter_mm;
  placed.covariance = usual_covariance(present());
  return placed;
}

LayoutChange ChangeBench::changed(ChangeKind kind, std::size_t target,
                                  const std::optional<Place>& place) const {
  LayoutChange change;
  change.kind = kind;
  change.target = target;
  change.place = place;
  change.targets = present();
  if (kind == ChangeKind::Remove) {
    change.id = present()[target].id;
    change.targets.erase(change.targets.begin() + static_cast<std::ptrdiff_t>(target));
  } else if (kind == ChangeKind::Relearn) {
    change.id = present()[target].id;
    if (const auto found = observed_.found.find(target); found != observed_.found.end()) {
      change.targets[target] = found->second;
      change.way_mm = (present()[target].position - found->second.position).norm();
    }
  } else {
    require(place.has_value(), "a target is moved or added to a place");
    const Target moved = placed(target, *place);
    change.id = moved.id;
    if (kind == ChangeKind::Add) {
      change.targets.push_back(moved);
    } else {
      change.way_mm = (present()[target].position - moved.position).norm();
      change.targets[target] = moved;
    }
  }
  MotionVisibility unhidden = all_unhidden(model_.motion.poses());
  for (std::size_t pose = 0; pose < unhidden.poses(); ++pose) {
    for (std::size_t side = 0; side < 2; ++side) {
      const TargetMask seen =
          observed_.unhidden.poses() > 0 ? observed_.unhidden.seen[pose][side] : ~TargetMask{0};
      unhidden.seen[pose][side] = after_change(seen, observed_.unsound, kind, target);
    }
  }
  change.after = standing_of(change.targets, unhidden, model_.bound_on(Q::Identifiability));
  return change;
}

bool ChangeBench::free(const Vec3& position, std::size_t except) const {
  for (std::size_t i = 0; i < present().size(); ++i) {
    if (i != except && (present()[i].position - position).norm() < model_.rules.spacing_mm) return false;
  }
  return true;
}

}  // namespace asterism
