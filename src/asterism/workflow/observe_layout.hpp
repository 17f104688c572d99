// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/evaluation/observed_body.hpp"
#include "asterism/io/recording.hpp"
#include "asterism/tracking/tracker.hpp"
#include "asterism/workflow/suggest_layout.hpp"

namespace asterism {

struct ObserveJob {
  TrackerOptions tracker;
  ObserveOptions observe;
  std::string body;  // whose targets; empty: that of the cell's layout task, or the only one that was seen
  int poses = 200;   // of the recording that are looked at, evenly
};

/// Tracks a recording and tells it as a cell: its rig, its bodies, their motion as it was observed, and of
/// the body's targets which were hidden when and which do not stand where the file has them. `cell` says
/// where targets may stand, where accuracy counts and what hides them; without one only removals can be
/// judged, which a warning says. Throws InputError for a recording without rig or bodies and for a body that
/// is not there, MeasurementError when the body was tracked in fewer than two frames.
[[nodiscard]] SuggestionSubject observe_layout(const Recording& recording, const std::optional<Cell>& cell,
                                               const ObserveJob& job, SuggestOptions& options,
                                               const Progress& progress);

}  // namespace asterism
