// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/scanning/candidate_study.hpp"

namespace asterism {

/// What each limit costs: the area that would be coverable besides, were it alone not asked. What the scanner
/// itself is limited by (range, field, incidence, sight) is lifted for the views that the cell allows, the
/// rest for the views that it alone forbids. Limits that cost nothing are left out; the dearest comes first.
[[nodiscard]] std::vector<LimitCost> limit_costs(const PlanGround& ground, const CandidateStudy& study);

/// Of all candidates that measure something, how many does each limit forbid in every pose of the platform?
/// In words: "clearance of the scanner (3900 of 4000)".
[[nodiscard]] std::string why_none_is_allowed(const PlanGround& ground, const CandidateStudy& study);

/// What is worth a look: undersides that are never covered, much that is seen obliquely only, open surfaces.
[[nodiscard]] std::vector<std::string> plan_remarks(const PlanGround& ground, const CandidateStudy& study,
                                                    const ScanPlan& plan);

}  // namespace asterism
