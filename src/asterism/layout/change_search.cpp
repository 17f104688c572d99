// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/change_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kPlaces = 21;     // purpose of the stream
constexpr std::size_t kHardPoses = 10;    // where the rest without the target is known worst
constexpr std::size_t kSpreadPoses = 8;   // and evenly over the motion
constexpr std::size_t kBatch = 16;        // changes evaluated in full at a time, on any number of threads
constexpr std::size_t kMostInFull = 512;  // then the search ends, and says so
constexpr int kMostSteps = 100;           // of the fine search
constexpr double kRounding = 1e-9;        // a bound and an error are summed in different orders
constexpr double kNoErrorMm = std::numeric_limits<double>::infinity();

/// A hair below: a bound and an error are summed in different orders.
std::optional<double> just_below(const ErrorOverMotion& error) {
  if (error.undetermined > 0 || !error.worst) return std::nullopt;
  return error.worst->mm * (1 - kRounding);
}

/// The targets that stay, with what is seen of each by itself, and the few poses that bounds are taken over.
struct Screen {
  std::vector<Target> targets;  // the last is the one that is placed
  MotionVisibility seen;        // of those that stay
  std::vector<std::size_t> poses;
  SeenMotion motion;  // of `poses`
};

MotionVisibility seen_alone(const ChangeBench& bench, const std::vector<std::size_t>& stay) {
  const MotionVisibility relied = bench.relied_on();
  MotionVisibility all{std::vector<std::array<TargetMask, 2>>(relied.poses(), {0, 0})};
  for (std::size_t i = 0; i < stay.size(); ++i) {
    const MotionVisibility one = bench.model().visibility_of(std::span(&bench.present()[stay[i]], 1));
    for (std::size_t pose = 0; pose < all.poses(); ++pose) {
      for (std::size_t side = 0; side < 2; ++side) {
        const TargetMask here = one.seen[pose][side] & (relied.seen[pose][side] >> stay[i]) & 1;
        all.seen[pose][side] |= here << i;
      }
    }
  }
  return all;
}

/// Poses by how badly those that stay know them, neighbours left out, and some evenly spread.
std::vector<std::size_t> poses_to_screen(const ChangeBench& bench, const std::vector<Target>& stay,
                                         const MotionVisibility& seen) {
  AccuracyOptions accuracy = bench.model().options.accuracy;
  accuracy.losses = static_cast<int>(bench.losses());
  const MotionAccuracy known =
      predict_accuracy(stay, bench.model().motion, seen, bench.model().points, accuracy);
  const std::size_t poses = seen.poses();
  std::vector<std::size_t> order(poses);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t pose) {
      return std::pair(known.after_losses().by_pose_mm[pose], known.nominal().by_pose_mm[pose]);
    };
    return key(a) > key(b);
  });
  std::vector<char> chosen(poses, 0);
  std::size_t hard = 0;
  for (const std::size_t pose : order) {
    if (hard == kHardPoses) break;
    const std::size_t from = pose > 2 ? pose - 2 : 0;
    if (std::any_of(chosen.begin() + static_cast<std::ptrdiff_t>(from),
                    chosen.begin() + static_cast<std::ptrdiff_t>(std::min(poses, pose + 3)),
                    [](char taken) { return taken != 0; })) {
      continue;
    }
    chosen[pose] = 1;
    ++hard;
  }
  for (std::size_t i = 0; i < kSpreadPoses; ++i) chosen[i * (poses - 1) / (kSpreadPoses - 1)] = 1;
  std::vector<std::size_t> list;
  for (std::size_t pose = 0; pose < poses; ++pose) {
    if (chosen[pose] != 0) list.push_back(pose);
  }
  return list;
}

Screen screen_for(const ChangeBench& bench, std::size_t target) {
  Screen screen;
  std::vector<std::size_t> stay;
  for (std::size_t i = 0; i < bench.present().size(); ++i) {
    if (i == target) continue;
    stay.push_back(i);
    screen.targets.push_back(bench.present()[i]);
  }
  screen.seen = seen_alone(bench, stay);
  screen.poses = poses_to_screen(bench, screen.targets, screen.seen);
  std::vector<RigidMotion> motion;
  for (const std::size_t pose : screen.poses) motion.push_back(bench.model().motion.tracker_from_body[pose]);
  screen.motion = seen_motion(motion, bench.model().motion.rig);
  screen.targets.emplace_back();
  return screen;
}

/// A standing that the change does not better, for a bound: all targets as each is seen by itself, over the
/// screen's poses; the visible count over all.
LayoutStanding bound_of(const ChangeBench& bench, const Screen& screen, const Target& placed,
                        const MotionVisibility& place_seen) {
  const std::size_t last = screen.targets.size() - 1;
  MotionVisibility seen = screen.seen;
  for (std::size_t pose = 0; pose < seen.poses(); ++pose) {
    for (std::size_t side = 0; side < 2; ++side) seen.seen[pose][side] |= place_seen.seen[pose][side] << last;
  }
  MotionVisibility few;
  for (const std::size_t pose : screen.poses) few.seen.push_back(seen.seen[pose]);
  std::vector<Target> targets = screen.targets;
  targets.back() = placed;
  AccuracyOptions accuracy = bench.model().options.accuracy;
  accuracy.losses = static_cast<int>(bench.losses());
  const MotionAccuracy known = predict_accuracy(targets, screen.motion, few, bench.model().points, accuracy);
  LayoutStanding at_best;
  at_best.violation =
      bench.missing_visible(seen) + bench.undetermined_violation(known.after_losses().undetermined);
  at_best.error_mm = just_below(known.after_losses());
  const auto over = error_over_losses(targets, screen.motion, few, bench.model(), bench.losses());
  if (over) at_best.all_losses_mm = *over * (1 - kRounding);
  return at_best;
}

bool apart(const LayoutChange& change, const std::vector<LayoutChange>& others, double spacing_mm) {
  return std::all_of(others.begin(), others.end(), [&](const LayoutChange& other) {
    return (other.place->position_mm - change.place->position_mm).norm() >= spacing_mm;
  });
}

/// The best, a spacing apart from one another.
std::vector<LayoutChange> distinct(const ChangeBench& bench, std::vector<LayoutChange> changes,
                                   std::size_t most) {
  std::stable_sort(changes.begin(), changes.end(),
                   [&](const auto& a, const auto& b) { return bench.prefers(a.after, b.after); });
  std::vector<LayoutChange> kept;
  for (LayoutChange& change : changes) {
    if (kept.size() == most) break;
    if (apart(change, kept, bench.model().rules.spacing_mm)) kept.push_back(std::move(change));
  }
  return kept;
}

/// Where a target could go beside a place: eight ways along the surface, turned by the golden angle each
/// time so that no direction is favoured, and up and down where the surface is a room.
std::vector<Place> places_around(const LayoutModel& model, const Place& at, double step_mm, int turn) {
  const auto [u, v] = along_surface(at.normal);
  std::vector<Vec3> ways;
  const double first = turn * std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < 8; ++i) {
    const double angle = first + 0.25 * std::numbers::pi * i;
    ways.emplace_back(std::cos(angle) * u + std::sin(angle) * v);
  }
  ways.push_back(at.normal);
  ways.push_back(-at.normal);
  std::vector<Place> places;
  for (const Vec3& way : ways) {
    const auto place =
        nearest_allowed_place(model.rules.surface, at.position_mm + step_mm * way, model.rules.clearance_mm);
    if (place && (place->position_mm - at.position_mm).norm() > 0.1 * step_mm) places.push_back(*place);
  }
  return places;
}

std::vector<LayoutChange> changes_to(const ChangeBench& bench, const LayoutChange& like,
                                     std::span<const Place> places) {
  const std::size_t except = like.kind == ChangeKind::Move ? like.target : bench.present().size();
  std::vector<std::optional<LayoutChange>> all(places.size());
  parallel_for(places.size(), [&](std::size_t i) {
    if (bench.free(places[i].position_mm, except)) {
      all[i] = bench.changed(like.kind, like.target, places[i]);
    }
  });
  std::vector<LayoutChange> changes;
  for (auto& change : all) {
    if (change) changes.push_back(std::move(*change));
  }
  return changes;
}

}  // namespace

std::vector<WatchedPlace> watched_places(const LayoutModel& model, int count) {
  double area = 0;
  for (const NamedPatch& named : model.rules.surface.patches) area += area_mm2(named.patch);
  RandomStream random(0, 0, kPlaces);
  // Thrown darts fill about 0.7 of what a lattice of this pitch would.
  const auto places = poisson_disc(model.rules.surface, 0.8 * std::sqrt(area / count),
                                   model.rules.clearance_mm, static_cast<std::size_t>(count), random);
  std::vector<WatchedPlace> watched(places.size());
  parallel_for(places.size(), [&](std::size_t i) {
    Target target;
    target.position = places[i].position_mm;
    target.normal = places[i].normal;
    target.diameter_mm = model.task.diameter_mm;
    watched[i] = {places[i], model.visibility_of(std::span(&target, 1))};
  });
  return watched;
}

ChangesFound best_places(const ChangeBench& bench, ChangeKind kind, std::size_t target,
                         std::span<const WatchedPlace> places, std::size_t most) {
  const std::size_t except = kind == ChangeKind::Move ? target : bench.present().size();
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (bench.free(places[i].place.position_mm, except)) open.push_back(i);
  }
  ChangesFound found;
  found.screened = open.size();
  if (open.empty()) return found;
  const Screen screen = screen_for(bench, except);
  std::vector<LayoutStanding> bounds(open.size());
  parallel_for(open.size(), [&](std::size_t i) {
    const WatchedPlace& place = places[open[i]];
    bounds[i] = bound_of(bench, screen, bench.placed(target, place.place), place.seen);
  });
  std::vector<std::size_t> order(open.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return bench.prefers(bounds[a], bounds[b]); });

  LayoutChange like;
  like.kind = kind;
  like.target = target;
  std::vector<LayoutChange> all;
  for (std::size_t next = 0; next < order.size();) {
    const bool full = found.best.size() == most;
    if (full && !bench.prefers(bounds[order[next]], found.best.back().after)) break;
    if (found.evaluated >= kMostInFull) {
      found.proven = false;
      break;
    }
    std::vector<Place> batch;
    for (; next < order.size() && batch.size() < kBatch; ++next)
      batch.push_back(places[open[order[next]]].place);
    found.evaluated += batch.size();
    std::vector<LayoutChange> changes = changes_to(bench, like, batch);
    std::move(changes.begin(), changes.end(), std::back_inserter(all));
    found.best = distinct(bench, all, most);
  }
  return found;
}

LayoutChange refined(const ChangeBench& bench, LayoutChange change, double start_mm, double finest_mm) {
  int turn = 0;
  for (double step = start_mm; step >= finest_mm && turn < kMostSteps; ++turn) {
    std::vector<LayoutChange> around =
        changes_to(bench, change, places_around(bench.model(), *change.place, step, turn));
    LayoutChange* best = &change;
    for (LayoutChange& other : around) {
      if (bench.prefers(other.after, best->after)) best = &other;
    }
    if (best == &change) {
      step /= 2;
    } else {
      change = LayoutChange(std::move(*best));
    }
  }
  return change;
}

std::optional<double> worst_nearby(const ChangeBench& bench, const LayoutChange& change, double beside_mm) {
  double worst = change.after.error_mm.value_or(kNoErrorMm);
  for (const LayoutChange& other :
       changes_to(bench, change, places_around(bench.model(), *change.place, beside_mm, 0))) {
    if (other.after.violation > change.after.violation + kRounding || !other.after.error_mm)
      return std::nullopt;
    worst = std::max(worst, *other.after.error_mm);
  }
  return worst < kNoErrorMm ? std::optional(worst) : std::nullopt;
}

}  // namespace asterism
