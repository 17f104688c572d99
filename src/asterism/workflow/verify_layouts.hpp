// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/workflow/verify_cell.hpp"

namespace asterism {

/// What the disturbance runs make of a body's layouts, the present one first.
struct DisturbedLayouts {
  std::vector<LayoutRuns> runs;
  std::vector<LayoutComparison> comparisons;
};

/// The present layout and those of the job under common random numbers: at rest, as the paper has it
/// (Tables 13 and 14), and over the motion. Throws InputError when the job's layouts are of another body.
[[nodiscard]] DisturbedLayouts disturb_layouts(const Cell& cell, const VerifiedBody& body,
                                               std::span<const double> times_s, const VerifyJob& job,
                                               const Occlusion& occlusion, const Progress& progress);

}  // namespace asterism
