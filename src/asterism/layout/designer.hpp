// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "asterism/cell/cell.hpp"
#include "asterism/layout/design.hpp"
#include "asterism/layout/layout_problem.hpp"
#include "asterism/optimization/optimizer.hpp"

namespace asterism {

/// Everything about one layout of the task's body. Targets without a normal face as the surface's nearest
/// place does.
[[nodiscard]] LayoutDesign evaluate_layout(const Cell& cell, std::span<const Target> targets,
                                           const DesignerOptions& options);

/// Searches for layouts: seeds, then the optimiser; `on_generation` and `workers` as optimize() has them.
[[nodiscard]] DesignResult design_layouts(const Cell& cell, const DesignerOptions& options,
                                          const OnGeneration& on_generation = {},
                                          const OptimizerWorkers& workers = {});

/// The same in two steps, for a run that is resumed or spread over processes: make the problem, run an
/// Optimizer on it, and tell what it found.
[[nodiscard]] DesignResult design_result(const LayoutProblem& problem, const OptimizationResult& found);

}  // namespace asterism
