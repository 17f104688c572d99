// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asterism/layout/change_bench.hpp"

namespace asterism {

/// A place with what each camera sees of a target on it alone.
struct WatchedPlace {
  Place place;
  MotionVisibility seen;  // bit 0
};
[[nodiscard]] std::vector<WatchedPlace> watched_places(const LayoutModel& model, int count);

struct ChangesFound {
  std::vector<LayoutChange> best;  // best first, `most` of them or fewer, a spacing apart
  std::size_t screened = 0, evaluated = 0;
  bool proven = true;
};

/// The best places for a target that is there (Move) or a new one (Add).
[[nodiscard]] ChangesFound best_places(const ChangeBench& bench, ChangeKind kind, std::size_t target,
                                       std::span<const WatchedPlace> places, std::size_t most);

/// A change's place sought along the surface by ever smaller steps, from `start_mm` down to `finest_mm`.
[[nodiscard]] LayoutChange refined(const ChangeBench& bench, LayoutChange change, double start_mm,
                                   double finest_mm);

/// The largest error when the foot stands so far beside its place; none when that breaks what was whole.
[[nodiscard]] std::optional<double> worst_nearby(const ChangeBench& bench, const LayoutChange& change,
                                                 double beside_mm);

}  // namespace asterism
