// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/cell/layout_task.hpp"
#include "asterism/layout/designer.hpp"

// What is known of a layout, in words: for the page and for the terminal.

namespace asterism {

/// "worst-error-1-lost" → "worst error after any 1 loss".
[[nodiscard]] std::string label_of_quantity(const std::string& name);

/// Three digits that count, whole numbers as they are; "–" for nothing.
[[nodiscard]] std::string text_of_value(const std::optional<double>& value);

/// Each constraint that does not hold: "visible is 3, at least 5 asked: 2 missing".
[[nodiscard]] std::vector<std::string> broken_constraints(std::span<const ConstraintState> constraints);
[[nodiscard]] std::vector<std::string> broken_constraints(const LayoutDesign& design);

/// Where the worst is and why: error, error after losses, visibility, what it can be taken for.
[[nodiscard]] std::vector<std::string> notes_on(const LayoutDesign& design, const LayoutTask& task,
                                                std::span<const double> pose_times_s);

}  // namespace asterism
