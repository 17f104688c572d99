// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_growth.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "asterism/calibration/body_learning_congruence.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

// Among so few points a known triangle is found by chance once in a hundred frames; more take four targets.
constexpr std::size_t kFewPoints = 40;
// Of two labellings that fit alike, one is taken only if its turn from the neighbouring frame is this
// many times smaller.
constexpr double kClearlyNearer = 2.0;

Sighting sighting_of(const Congruence& found, std::size_t frame) {
  Sighting sighting{frame, found.b_from_a, found.covariance, {}};
  for (const PointPair& pair : found.pairs) sighting.points.push_back({pair.b, pair.a});
  return sighting;
}

/// Of several equally large labellings that fit alike the one that turned least from the neighbouring
/// frame, if one did so clearly.
const Congruence* choose(const std::vector<Congruence>& found, const RigidMotion& neighbour) {
  constexpr double kAlike = 25.0;  // χ² between labellings of which neither can be ruled out
  const auto turn = [&](const Congruence* one) {
    return rotation_angle(one->b_from_a.rotation, neighbour.rotation);
  };
  std::vector<const Congruence*> alike;
  for (const Congruence& one : found) {
    const bool as_large = one.pairs.size() == found.front().pairs.size();
    if (as_large && one.chi_square <= found.front().chi_square + kAlike) alike.push_back(&one);
  }
  std::stable_sort(alike.begin(), alike.end(),
                   [&](const Congruence* p, const Congruence* q) { return turn(p) < turn(q); });
  const bool clear = alike.size() == 1 || turn(alike[1]) > kClearlyNearer * turn(alike[0]);
  return clear ? alike.front() : nullptr;
}

/// Looks for the set in each frame, from the one where its coordinates come from onwards and backwards.
void locate(RigidSet& set, std::size_t home, std::span<const ObservedFrame> frames,
            const BodyLearningOptions& options) {
  std::vector<std::vector<Congruence>> found(frames.size());
  parallel_for(frames.size(), [&](std::size_t f) {
    const auto points = points_of(frames[f]);
    const std::size_t least = points.size() <= kFewPoints ? 3 : least_size(options);
    found[f] = congruent_subsets(set.targets, points, options.deformation_mm, least);
  });
  set.sightings.clear();
  set.ambiguous_frames = 0;
  RigidMotion neighbour;
  const auto visit = [&](std::size_t f) {
    if (found[f].empty()) return;
    if (const Congruence* chosen = choose(found[f], neighbour)) {
      neighbour = chosen->b_from_a;
      set.sightings.push_back(sighting_of(*chosen, f));
    } else {
      ++set.ambiguous_frames;
    }
  };
  for (std::size_t f = home; f < frames.size(); ++f) visit(f);
  neighbour = RigidMotion{};
  for (std::size_t f = home; f-- > 0;) visit(f);
  std::sort(set.sightings.begin(), set.sightings.end(),
            [](const Sighting& p, const Sighting& q) { return p.frame < q.frame; });
}

/// A frame's point in the set's frame, as well as the point itself is known.
Point in_set(const Sighting& sighting, const Point& point) {
  const Mat3 back = sighting.tracker_from_set.rotation.conjugate().toRotationMatrix();
  Point moved = point;
  moved.in_tracker = sighting.tracker_from_set.inverse() * point.in_tracker;
  moved.covariance = back * point.covariance * back.transpose();
  return moved;
}

/// Each target's weighted mean over its sightings; the poses follow.
void refine(RigidSet& set, std::span<const ObservedFrame> frames, const BodyLearningOptions& options) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Mat3> information(set.targets.size(), Mat3::Zero());
    std::vector<Vec3> weighted(set.targets.size(), Vec3::Zero());
    for (const Sighting& sighting : set.sightings) {
      for (const LabelledPoint& label : sighting.points) {
        const Point point =
            in_set(sighting, frames[sighting.frame].points[static_cast<std::size_t>(label.point)]);
        const Mat3 weight = point.covariance.inverse();
        information[static_cast<std::size_t>(label.target)] += weight;
        weighted[static_cast<std::size_t>(label.target)] += weight * point.in_tracker;
      }
    }
    for (std::size_t t = 0; t < set.targets.size(); ++t) {
      if (!(information[t].trace() > 0)) continue;
      set.targets[t].covariance = information[t].inverse();
      set.targets[t].in_tracker = set.targets[t].covariance * weighted[t];
    }
    for (Sighting& sighting : set.sightings) {
      std::vector<PointPair> pairs;
      for (const LabelledPoint& label : sighting.points) pairs.push_back({label.target, label.point});
      const auto fit =
          fit_pairs(set.targets, frames[sighting.frame].points, std::move(pairs), options.deformation_mm);
      if (!fit) continue;
      sighting.tracker_from_set = fit->b_from_a;
      sighting.covariance = fit->covariance;
    }
  }
}

/// A point that is no target yet, in the set's frame.
struct Loose {
  std::size_t sighting;
  int point;
  Point in_set;
  Vec3 in_tracker;
};

std::vector<Loose> loose_points(const RigidSet& set, std::span<const ObservedFrame> frames) {
  std::vector<Loose> loose;
  for (std::size_t s = 0; s < set.sightings.size(); ++s) {
    const Sighting& sighting = set.sightings[s];
    const auto& points = frames[sighting.frame].points;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const bool taken =
          std::any_of(sighting.points.begin(), sighting.points.end(), [&](const LabelledPoint& label) {
            const auto used = static_cast<std::size_t>(label.point);
            return used == p || share_a_centre(points[used], points[p]);
          });
      if (!taken)
        loose.push_back({s, static_cast<int>(p), in_set(sighting, points[p]), points[p].in_tracker});
    }
  }
  return loose;
}

/// Those of the loose points that lie where `place` does, one a sighting; empty when they hardly moved
/// in the tracker: that is a point of the background near the axis of a turn.
std::vector<const Loose*> together(const std::vector<Loose>& loose, const Loose& place,
                                   const BodyLearningOptions& options) {
  std::vector<const Loose*> same;
  double way = 0;
  for (const Loose& other : loose) {
    if ((other.in_set.in_tracker - place.in_set.in_tracker).squaredNorm() > 400.0) continue;
    if (!same.empty() && same.back()->sighting == other.sighting) continue;
    const double apart =
        mahalanobis_square(RigidMotion{}, Mat6::Zero(), place.in_set, other.in_set, options.deformation_mm);
    if (apart > kPointGate) continue;
    way = std::max(way, (other.in_tracker - place.in_tracker).norm());
    same.push_back(&other);
  }
  if (way < options.least_motion_mm) same.clear();
  return same;
}

/// Adds as a target the loose points that come back most often at one place of the set's frame.
bool add_target(RigidSet& set, std::span<const ObservedFrame> frames, const BodyLearningOptions& options) {
  const auto loose = loose_points(set, frames);
  std::vector<const Loose*> best;
  for (const Loose& place : loose) {
    auto same = together(loose, place, options);
    if (same.size() > best.size()) best = std::move(same);
  }
  if (best.size() < 2) return false;
  Point target = best.front()->in_set;
  target.left = target.right = -1;
  const int index = static_cast<int>(set.targets.size());
  set.targets.push_back(target);
  for (const Loose* one : best) set.sightings[one->sighting].points.push_back({one->point, index});
  return true;
}

RigidSet without_rare_targets(const RigidSet& set) {
  std::vector<bool> keep;
  for (const int count : sightings_of_targets(set)) keep.push_back(count >= 2);
  return with_targets(set, keep);
}

/// Looks for the set everywhere and adds what comes back, until nothing is added.
void grow_to_rest(RigidSet& set, std::size_t home, std::span<const ObservedFrame> frames,
                  const BodyLearningOptions& options) {
  const std::size_t most = 4 * static_cast<std::size_t>(options.targets) + 8;
  for (std::size_t before = 0; before != set.targets.size();) {
    before = set.targets.size();
    locate(set, home, frames, options);
    refine(set, frames, options);
    while (set.targets.size() < most && add_target(set, frames, options)) refine(set, frames, options);
  }
  set = without_rare_targets(set);
}

/// When targets are often hidden, a frame may show too few of those known to be found, yet enough with one
/// that another frame shows once. So one such point at a time is taken for a target, and kept if it comes
/// back.
bool grow_by_trial(RigidSet& set, std::size_t home, std::span<const ObservedFrame> frames,
                   const BodyLearningOptions& options) {
  constexpr std::size_t kMostTrials = 200;
  const auto loose = loose_points(set, frames);
  for (std::size_t i = 0; i < std::min(loose.size(), kMostTrials); ++i) {
    RigidSet trial = set;
    trial.targets.push_back(loose[i].in_set);
    trial.targets.back().left = trial.targets.back().right = -1;
    grow_to_rest(trial, home, frames, options);
    if (trial.targets.size() <= set.targets.size() || trial.sightings.size() <= set.sightings.size())
      continue;
    set = std::move(trial);
    return true;
  }
  return false;
}

}  // namespace

std::size_t least_size(const BodyLearningOptions& options) { return options.targets == 3 ? 3 : 4; }

std::span<const Point> points_of(const ObservedFrame& frame) {
  constexpr std::size_t kMostPoints = 250;
  if (frame.points.size() > kMostPoints) return {};
  return frame.points;
}

double rms_motion(const RigidMotion& from, const RigidMotion& to, std::span<const Point> targets) {
  double sum = 0;
  for (const Point& target : targets)
    sum += (to * target.in_tracker - from * target.in_tracker).squaredNorm();
  return std::sqrt(sum / static_cast<double>(targets.size()));
}

std::vector<int> sightings_of_targets(const RigidSet& set) {
  std::vector<int> seen(set.targets.size(), 0);
  for (const Sighting& sighting : set.sightings) {
    for (const LabelledPoint& label : sighting.points) ++seen[static_cast<std::size_t>(label.target)];
  }
  return seen;
}

RigidSet with_targets(const RigidSet& set, const std::vector<bool>& keep) {
  RigidSet kept = set;
  kept.targets.clear();
  std::vector<int> place(set.targets.size(), -1);
  for (std::size_t t = 0; t < set.targets.size(); ++t) {
    if (!keep[t]) continue;
    place[t] = static_cast<int>(kept.targets.size());
    kept.targets.push_back(set.targets[t]);
  }
  for (Sighting& sighting : kept.sightings) {
    std::erase_if(sighting.points,
                  [&](const LabelledPoint& l) { return place[static_cast<std::size_t>(l.target)] < 0; });
    for (LabelledPoint& label : sighting.points) label.target = place[static_cast<std::size_t>(label.target)];
  }
  return kept;
}

RigidSet grow_rigid_set(const GrowthSeed& seed, std::span<const ObservedFrame> frames,
                        const BodyLearningOptions& options) {
  RigidSet set;
  for (const int point : seed.points) {
    set.targets.push_back(frames[seed.frame].points[static_cast<std::size_t>(point)]);
    set.targets.back().left = set.targets.back().right = -1;
  }
  // The set's frame is the tracker's in the seed's frame, and stays so: turns are told from there.
  grow_to_rest(set, seed.frame, frames, options);
  const auto told = static_cast<std::size_t>(options.targets);
  constexpr std::size_t kLeastSightings = 3;
  while (set.targets.size() < told && set.sightings.size() >= kLeastSightings) {
    if (!grow_by_trial(set, seed.frame, frames, options)) break;
  }
  for (const Sighting& sighting : set.sightings) {
    set.motion_mm = std::max(set.motion_mm, rms_motion(set.sightings.front().tracker_from_set,
                                                       sighting.tracker_from_set, set.targets));
  }
  return set;
}

}  // namespace asterism
