// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/evaluation/observed_body.hpp"
#include "asterism/layout/suggestion.hpp"

namespace asterism {

/// What a change is sought for: a cell as planned, or a recording told as a cell (observe_layout.hpp).
struct SuggestionSubject {
  Cell cell;
  ObservedSights observed;
  std::vector<double> pose_times_s;       // of the motion's poses where the cell's own do not tell them
  std::vector<std::string> observations;  // in words: what the recording shows; empty for a cell
  std::vector<ObservedTarget> targets;    // one a present target; empty for a cell
  std::vector<std::string> warnings;
};

/// A target as it stands.
struct PresentTarget {
  std::string id;
  double seen = 0;  // share of the motion in which both cameras see it, by geometry and what was observed
  struct Cause {
    std::string what;  // "too oblique (left)", "hidden by pipe (right)"
    double share = 0;  // of the motion
  };
  std::vector<Cause> unseen_since;  // most often first
  LayoutStanding without;           // what the others are worth by themselves
  std::optional<ObservedTarget> observed;
};

struct SuggestedChange {
  Cell cell;
  Suggestion suggestion;
  std::vector<double> pose_times_s;
  std::vector<std::string> limits;  // what limits the layout as it stands
  std::vector<PresentTarget> targets;
  std::vector<std::string> observations, warnings;
  std::string verdict;  // what to do next, in one sentence
  double seconds = 0;
};
[[nodiscard]] SuggestedChange suggest_layout(const SuggestionSubject& subject, const SuggestOptions& options);

/// "Move P4 to (x, y, z) on `rim`, 184 mm away: worst error after any one loss 0.094 → 0.061 mm (−35 %), …"
[[nodiscard]] std::string in_words(const LayoutChange& change, const Suggestion& suggestion,
                                   const LayoutTask& task);

/// For the terminal; so many of each kind.
[[nodiscard]] std::string text_of(const SuggestedChange& suggested, std::size_t told);
/// docs/formats.md tells the keys.
[[nodiscard]] nlohmann::ordered_json json_of(const SuggestedChange& suggested, const SuggestOptions& options);

/// OUT/suggestion.json, and OUT/bodies.toml where something is suggested: all bodies, the task's with its
/// targets after the change, the others untouched.
void write_suggestion(const std::filesystem::path& out, const SuggestedChange& suggested,
                      const SuggestOptions& options);

}  // namespace asterism
