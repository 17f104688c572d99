// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/layout/layout_model.hpp"

namespace asterism {
namespace {

enum Purpose : std::uint32_t { kRoom = 1, kPushing, kSight };

/// The most targets for which room was found: by darts, then one more at a time by pushing them apart.
int room_for(const LayoutRules& rules) {
  std::size_t found = 0;
  for (std::uint64_t tries = 0; tries < 5; ++tries) {
    RandomStream random(0, tries, kRoom);
    const auto darts = poisson_disc(rules.surface, rules.spacing_mm, rules.clearance_mm,
                                    static_cast<std::size_t>(rules.most), random);
    found = std::max(found, darts.size());
  }
  auto room = static_cast<int>(found);
  const auto holds = [&](int targets) {
    for (std::uint64_t tries = 0; tries < 20; ++tries) {
      RandomStream random(static_cast<std::uint64_t>(targets), tries, kPushing);
      if (spread_apart(targets, rules, random)) return true;
    }
    return false;
  };
  while (room > 0 && room < rules.most && holds(room + 1)) ++room;
  return room;
}

/// Of places that no camera pair sees in a pose, the reason that is met most often.
std::string main_reason(const LayoutModel& model, std::span<const Place> places, std::size_t pose) {
  std::array<int, kSightFailures> counts{};
  for (const Place& place : places) {
    const auto target = model.targets_at(std::vector<Vec3>{place.position_mm});
    for (const Side side : {Side::Left, Side::Right}) {
      const auto sights = look_at(target, model.motion.tracker_from_body[pose], model.motion.rig, side,
                                  model.volume, model.options.visibility);
      const bool hidden = !sights[0].fails &&
                          model.occlusion.hidden_by(target[0], model.carrier, model.cell_poses[pose], side);
      if (sights[0].fails) ++counts[static_cast<std::size_t>(*sights[0].fails)];
      if (hidden) ++counts[static_cast<std::size_t>(SightFailure::Hidden)];
    }
  }
  const auto most = std::max_element(counts.begin(), counts.end()) - counts.begin();
  return std::string(text_of(static_cast<SightFailure>(most)));
}

/// By pose: how many of the places both cameras see, each place by itself.
std::vector<int> seen_places(const LayoutModel& model, std::span<const Place> places) {
  std::vector<MotionVisibility> seen(places.size());
  parallel_for(places.size(), [&](std::size_t i) {
    seen[i] = model.visibility_of(model.targets_at(std::vector<Vec3>{places[i].position_mm}));
  });
  std::vector<int> counts(model.motion.poses());
  for (const MotionVisibility& one : seen) {
    for (std::size_t pose = 0; pose < counts.size(); ++pose) counts[pose] += one.both(pose) != 0 ? 1 : 0;
  }
  return counts;
}

}  // namespace

std::optional<std::string> check_room(LayoutModel& model) {
  LayoutRules& rules = model.rules;
  const int room = room_for(rules);
  if (room < rules.fewest) {
    throw InputError("layout task",
                     fmt::format("the surface holds no {} targets {} mm apart: room was found for {}; "
                                 "lower `fewest` or `spacing_mm`, or allow more of the surface",
                                 rules.fewest, rules.spacing_mm, room));
  }
  if (room >= rules.most) return std::nullopt;
  const int asked = rules.most;
  rules.most = room;
  return fmt::format("room was found for {} targets {} mm apart; more, up to the {} asked for, are not tried",
                     room, rules.spacing_mm, asked);
}

std::optional<std::string> check_sight(const LayoutModel& model) {
  RandomStream random(0, 0, kSight);
  std::vector<Place> places;
  for (int i = 0; i < model.options.places; ++i) {
    const auto place = random_place(model.rules.surface, model.rules.clearance_mm, random);
    if (place) places.push_back(*place);
  }
  if (places.empty()) throw InputError("layout task", "the keep-outs leave no place on the surface");
  const std::vector<int> seen = seen_places(model, places);
  const auto worst = static_cast<std::size_t>(std::min_element(seen.begin(), seen.end()) - seen.begin());
  if (seen[worst] == 0) {
    const auto blind = std::count(seen.begin(), seen.end(), 0);
    throw InputError(
        "layout task",
        fmt::format(
            "in {} of {} poses, first at {:.3f} s, none of {} places of the surface is seen by both "
            "cameras: {}; move the tracker, widen its volume, or change the motion",
            blind, seen.size(),
            model.times_s[static_cast<std::size_t>(std::find(seen.begin(), seen.end(), 0) - seen.begin())],
            places.size(), main_reason(model, places, worst)));
  }
  const auto apart = poisson_disc(model.rules.surface, model.rules.spacing_mm, model.rules.clearance_mm,
                                  places.size(), random);
  const std::vector<int> seen_apart = seen_places(model, apart);
  const auto fewest = std::min_element(seen_apart.begin(), seen_apart.end());
  const double needed = model.bound_on(LayoutQuantity::Visible);
  if (*fewest >= needed) return std::nullopt;
  return fmt::format(
      "at {:.3f} s both cameras see only {} of {} places that stand {} mm apart, and {} targets must be "
      "visible",
      model.times_s[static_cast<std::size_t>(fewest - seen_apart.begin())], *fewest, apart.size(),
      model.rules.spacing_mm, needed);
}

std::vector<PlaceInformation> information_of(const LayoutModel& model, std::span<const Place> places) {
  std::vector<PlaceInformation> information(places.size());
  AccuracyOptions by_pairs = model.options.accuracy;
  by_pairs.single_views = false;
  parallel_for(places.size(), [&](std::size_t i) {
    const auto target = model.targets_at(std::vector<Vec3>{places[i].position_mm});
    const auto seen = model.visibility_of(target);
    for (std::size_t pose = 0; pose < model.motion.poses(); ++pose) {
      const auto one = pose_information(target, seen.seen[pose], model.motion.tracker_from_body[pose],
                                        model.motion.rig, by_pairs);
      information[i].push_back(one ? *one : Mat6(Mat6::Zero()));
    }
  });
  return information;
}

}  // namespace asterism
