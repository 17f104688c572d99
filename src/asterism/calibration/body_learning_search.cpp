// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_search.hpp"

#include <algorithm>

#include "asterism/calibration/body_learning_congruence.hpp"
#include "asterism/calibration/body_learning_growth.hpp"
#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

constexpr std::size_t kKeyFrames = 16;   // pairs of them are searched: 120
constexpr std::size_t kMostSeeds = 300;  // that are grown

std::vector<std::size_t> key_frames(std::span<const ObservedFrame> frames,
                                    const BodyLearningOptions& options) {
  std::vector<std::size_t> rich;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (points_of(frames[f]).size() >= least_size(options)) rich.push_back(f);
  }
  if (rich.size() <= kKeyFrames) return rich;
  std::vector<std::size_t> spread;
  for (std::size_t i = 0; i < kKeyFrames; ++i)
    spread.push_back(rich[i * (rich.size() - 1) / (kKeyFrames - 1)]);
  return spread;
}

std::vector<GrowthSeed> seeds_between(const ObservedFrame& from, std::size_t from_index,
                                      const ObservedFrame& to, const BodyLearningOptions& options) {
  std::vector<GrowthSeed> seeds;
  const auto points = points_of(from);
  for (const Congruence& found :
       congruent_subsets(points, points_of(to), options.deformation_mm, least_size(options))) {
    GrowthSeed seed{from_index, {}};
    std::vector<Point> subset;
    for (const PointPair& pair : found.pairs) {
      seed.points.push_back(pair.a);
      subset.push_back(points[static_cast<std::size_t>(pair.a)]);
    }
    if (rms_motion(RigidMotion{}, found.b_from_a, subset) >= options.least_motion_mm)
      seeds.push_back(std::move(seed));
  }
  return seeds;
}

/// Of all pairs of key frames, the largest first.
std::vector<GrowthSeed> find_seeds(std::span<const ObservedFrame> frames,
                                   const BodyLearningOptions& options) {
  const auto keys = key_frames(frames, options);
  std::vector<std::pair<std::size_t, std::size_t>> tasks;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    for (std::size_t j = i + 1; j < keys.size(); ++j) tasks.emplace_back(keys[i], keys[j]);
  }
  std::vector<std::vector<GrowthSeed>> found(tasks.size());
  parallel_for(tasks.size(), [&](std::size_t t) {
    found[t] = seeds_between(frames[tasks[t].first], tasks[t].first, frames[tasks[t].second], options);
  });
  std::vector<GrowthSeed> seeds;
  for (auto& some : found) std::move(some.begin(), some.end(), std::back_inserter(seeds));
  std::stable_sort(seeds.begin(), seeds.end(), [](const GrowthSeed& p, const GrowthSeed& q) {
    return p.points.size() > q.points.size();
  });
  return seeds;
}

bool known(const GrowthSeed& seed, const std::vector<RigidSet>& sets) {
  return std::any_of(sets.begin(), sets.end(), [&](const RigidSet& set) {
    const auto sighting = std::find_if(set.sightings.begin(), set.sightings.end(),
                                       [&](const Sighting& s) { return s.frame == seed.frame; });
    if (sighting == set.sightings.end()) return false;
    const auto shared = std::count_if(seed.points.begin(), seed.points.end(), [&](int point) {
      return std::any_of(sighting->points.begin(), sighting->points.end(),
                         [&](const LabelledPoint& label) { return label.point == point; });
    });
    return shared >= 2;
  });
}

std::size_t observations(const RigidSet& set) {
  std::size_t count = 0;
  for (const Sighting& sighting : set.sightings) count += sighting.points.size();
  return count;
}

}  // namespace

std::vector<RigidSet> find_rigid_sets(std::span<const ObservedFrame> frames,
                                      const BodyLearningOptions& options) {
  std::vector<RigidSet> sets;
  std::size_t tried = 0;
  for (const GrowthSeed& seed : find_seeds(frames, options)) {
    if (known(seed, sets) || ++tried > kMostSeeds) continue;
    RigidSet set = grow_rigid_set(seed, frames, options);
    constexpr std::size_t kLeastSightings = 3;  // two frames may agree by chance
    if (set.targets.size() < least_size(options) || set.sightings.size() < kLeastSightings) continue;
    sets.push_back(std::move(set));
  }
  std::stable_sort(sets.begin(), sets.end(),
                   [](const RigidSet& p, const RigidSet& q) { return observations(p) > observations(q); });
  return sets;
}

int count_static_points(std::span<const ObservedFrame> frames, const BodyLearningOptions& options) {
  if (frames.empty()) return 0;
  int count = 0;
  const auto& first = frames[frames.size() / 2].points;
  for (const Point& point : first) {
    const auto again = std::count_if(frames.begin(), frames.end(), [&](const ObservedFrame& frame) {
      return std::any_of(frame.points.begin(), frame.points.end(), [&](const Point& other) {
        return (other.in_tracker - point.in_tracker).norm() < options.least_motion_mm;
      });
    });
    if (2 * static_cast<std::size_t>(again) >= frames.size()) ++count;
  }
  return count;
}

}  // namespace asterism
