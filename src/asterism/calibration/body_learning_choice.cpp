// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace asterism {
namespace {

// A second body that gave fewer observations than this share of the first is no rival to it.
constexpr double kRival = 1.0 / 3.0;

Vec3 place_of(const RigidSet& set) {
  Vec3 sum = Vec3::Zero();
  for (const Point& target : set.targets) sum += target.in_tracker;
  return set.sightings.front().tracker_from_set * (sum / static_cast<double>(set.targets.size()));
}

/// "6 targets near (12, 340, 2400) mm, seen in 18 frames, moved by up to 120 mm".
std::string description(const RigidSet& set, std::span<const ObservedFrame> frames) {
  const Vec3 place = place_of(set);
  return fmt::format(
      "{} targets near ({:.0f}, {:.0f}, {:.0f}) mm in frame {}, seen in {} frames, moved by up to {:.1f} mm",
      set.targets.size(), place.x(), place.y(), place.z(), frames[set.sightings.front().frame].centres.frame,
      set.sightings.size(), set.motion_mm);
}

int observations(const RigidSet& set) {
  int sum = 0;
  for (const int count : sightings_of_targets(set)) sum += count;
  return sum;
}

/// Drops what came along in a few frames only, where more than the told number did. Says how many.
int drop_stragglers(RigidSet& set, std::size_t told) {
  if (set.targets.size() <= told) return 0;
  const auto seen = sightings_of_targets(set);
  std::vector<int> sorted = seen;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const int rarest_target = sorted[told - 1], commonest_other = sorted[told];
  if (2 * commonest_other >= rarest_target) return 0;
  std::vector<bool> keep;
  for (const int count : seen) keep.push_back(count > commonest_other);
  set = with_targets(set, keep);
  return static_cast<int>(seen.size() - told);
}

NoBody nothing_found(std::span<const ObservedFrame> frames, const BodyLearningOptions& options) {
  const int resting = count_static_points(frames, options);
  if (resting >= 3) {
    return {
        BodyLearningFailure::NothingMoves,
        fmt::format(
            "nothing moves: {} points keep their places to {} mm in at least half of the {} frames. A body "
            "at rest cannot be told from the background; move it, best by turning it 10° and more about "
            "two axes",
            resting, options.least_motion_mm, frames.size())};
  }
  std::size_t most = 0;
  for (const ObservedFrame& frame : frames) most = std::max(most, frame.points.size());
  return {BodyLearningFailure::TooFewTargets,
          fmt::format(
              "no {} points keep their distances over three frames or more (at most {} points were seen by "
              "both cameras in a frame)",
              options.targets == 3 ? 3 : 4, most)};
}

NoBody wrong_count(const std::vector<RigidSet>& sets, std::span<const ObservedFrame> frames, int told) {
  const RigidSet& best = sets.front();
  const auto found = static_cast<int>(best.targets.size());
  std::string what = found < told ? fmt::format("only {} of {} targets were found: ", found, told)
                                  : fmt::format("more points move together than the {} told: ", told);
  what += description(best, frames);
  for (std::size_t s = 1; s < sets.size(); ++s) what += "; also " + description(sets[s], frames);
  what += found < told ? ". Are the missing ones seen by both cameras, in three frames or more?"
                       : fmt::format(". Does the body have {}?", found);
  return {found < told ? BodyLearningFailure::TooFewTargets : BodyLearningFailure::TooManyTargets,
          std::move(what)};
}

}  // namespace

Result<ChosenSet, NoBody> choose_set(const std::vector<RigidSet>& sets, std::span<const ObservedFrame> frames,
                                     const BodyLearningOptions& options) {
  if (sets.empty()) return tl::unexpected(nothing_found(frames, options));
  const auto told = static_cast<std::size_t>(options.targets);
  std::vector<ChosenSet> fitting;
  std::vector<std::string> passed_over;
  for (const RigidSet& set : sets) {
    ChosenSet candidate{set, {}};
    const int dropped = drop_stragglers(candidate.set, told);
    if (candidate.set.targets.size() != told) {
      passed_over.push_back("passed over, since it has not as many targets as told: " +
                            description(set, frames));
      continue;
    }
    if (dropped > 0) {
      candidate.warnings.push_back(fmt::format(
          "{} more points moved along with the body, each in a few frames only: left out", dropped));
    }
    fitting.push_back(std::move(candidate));
  }
  if (fitting.empty()) return tl::unexpected(wrong_count(sets, frames, options.targets));

  ChosenSet& best = fitting.front();
  std::string rivals;
  for (std::size_t s = 1; s < fitting.size(); ++s) {
    if (observations(fitting[s].set) < kRival * observations(best.set)) {
      best.warnings.push_back("a rarer set of points moves too: " + description(fitting[s].set, frames));
    } else {
      rivals += "; " + description(fitting[s].set, frames);
    }
  }
  if (!rivals.empty()) {
    return tl::unexpected(
        NoBody{BodyLearningFailure::SeveralBodies,
               fmt::format("several bodies of {} targets move against each other: {}{}. Cover or stop "
                           "all but one",
                           told, description(best.set, frames), rivals)});
  }
  if (best.set.ambiguous_frames > static_cast<int>(best.set.sightings.size())) {
    return tl::unexpected(NoBody{BodyLearningFailure::Ambiguous,
                                 fmt::format("{} frames of {} can be read in two ways: the targets fit "
                                             "themselves under another labelling. Move "
                                             "one of them, or record smaller steps",
                                             best.set.ambiguous_frames, frames.size())});
  }
  if (best.set.ambiguous_frames > 0) {
    best.warnings.push_back(
        fmt::format("{} frames could be read in two ways: left out", best.set.ambiguous_frames));
  }
  best.warnings.insert(best.warnings.end(), passed_over.begin(), passed_over.end());
  return std::move(best);
}

}  // namespace asterism
