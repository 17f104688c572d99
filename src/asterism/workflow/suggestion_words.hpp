// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/workflow/suggest_layout.hpp"

// What limits a layout as it stands, in words.

namespace asterism {

/// Where and when the worst error is, after which loss; when the fewest targets are seen, and what hides the
/// others there; what is broken.
[[nodiscard]] std::vector<std::string> limits_in_words(const SuggestionSubject& subject,
                                                       const LayoutModel& model, const Suggestion& suggestion,
                                                       std::span<const double> pose_times_s);

/// How much of the motion each present target is seen, what hides it, and what the others are worth.
[[nodiscard]] std::vector<PresentTarget> present_targets(const SuggestionSubject& subject,
                                                         const LayoutModel& model,
                                                         const Suggestion& suggestion);

}  // namespace asterism
