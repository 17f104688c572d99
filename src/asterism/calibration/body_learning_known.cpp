// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_known.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "asterism/calibration/body_learning_congruence.hpp"

namespace asterism {
namespace {

/// How many targets of the body the set has, in the body's own places.
std::size_t shared_targets(const RigidSet& set, const Body& body, double error_mm) {
  // The gate of a congruence is √kPointGate sigmas of a pair.
  const double variance = error_mm * error_mm / (2 * kPointGate);
  std::vector<Point> learnt, known;
  for (const Point& target : set.targets) learnt.push_back({target.in_tracker, variance * Mat3::Identity()});
  for (const Target& target : body.targets) known.push_back({target.position, variance * Mat3::Identity()});
  const std::size_t least = std::min({learnt.size(), known.size(), std::size_t{4}});
  if (least < 3) return 0;
  const auto found = congruent_subsets(learnt, known, 0.0, least);
  return found.empty() ? 0 : found.front().pairs.size();
}

/// All of the body's targets are in the set, or all of the set's in the body.
bool is(const RigidSet& set, const Body& body, double error_mm) {
  return shared_targets(set, body, error_mm) >= std::min(set.targets.size(), body.targets.size());
}

NoBody known_already(const std::string& known, const std::string& name) {
  return {BodyLearningFailure::KnownBody,
          fmt::format("what moves is {}, known already; `{}` was not found. Is `{}` seen by both cameras, "
                      "with all its targets, in three frames or more? To learn a known body anew, give its "
                      "own name",
                      known, name, name)};
}

}  // namespace

Result<std::vector<RigidSet>, NoBody> unknown_sets(std::vector<RigidSet> sets, const std::string& name,
                                                   const Body* nominal, std::span<const Body> others,
                                                   double error_mm) {
  std::vector<RigidSet> unknown, meant;
  std::vector<std::string> known;
  for (RigidSet& set : sets) {
    if (nominal && is(set, *nominal, error_mm)) {
      meant.push_back(std::move(set));
      continue;
    }
    const auto other =
        std::find_if(others.begin(), others.end(), [&](const Body& body) { return is(set, body, error_mm); });
    if (other == others.end()) {
      unknown.push_back(std::move(set));
    } else if (const std::string words = fmt::format("`{}`", other->name);
               std::find(known.begin(), known.end(), words) == known.end()) {
      known.push_back(words);
    }
  }
  if (!meant.empty()) return meant;
  if (unknown.empty() && !known.empty()) {
    return tl::unexpected(known_already(fmt::format("{}", fmt::join(known, ", ")), name));
  }
  return unknown;
}

std::optional<NoBody> mistaken_for_known(const RigidSet& set, const std::string& name, const Body* nominal,
                                         std::span<const Body> others, double error_mm) {
  if (nominal && is(set, *nominal, error_mm)) return std::nullopt;
  for (const Body& other : others) {
    const std::size_t shared = shared_targets(set, other, error_mm);
    if (shared < 4 || 2 * shared <= set.targets.size()) continue;
    return known_already(
        fmt::format("`{}` ({} of {} points lie as its targets do)", other.name, shared, set.targets.size()),
        name);
  }
  return std::nullopt;
}

}  // namespace asterism
