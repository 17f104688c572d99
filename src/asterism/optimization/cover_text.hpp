// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "asterism/optimization/set_cover.hpp"

namespace asterism {

/// A set cover problem in the form of the OR-Library (Beasley 1990), so that others can solve it too: the
/// numbers of rows and columns, each column's cost, then for each row how many columns cover it and which,
/// counted from 1. What that form does not know follows as words with numbers: share, weights (by row),
/// demands (by row), groups (by column, counted from 1), group_costs. Rows that no column covers are left
/// out.
[[nodiscard]] std::string text_of(const SetCoverProblem& problem);

/// Reads that form, and the OR-Library's own files. `name` is told in errors. Throws InputError with the
/// line.
[[nodiscard]] SetCoverProblem cover_problem_of(std::string_view text, const std::string& name);

}  // namespace asterism
