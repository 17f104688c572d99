// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/scanning/cell_sight.hpp"
#include "asterism/scanning/plan_options.hpp"
#include "asterism/scanning/robot_reach.hpp"

namespace asterism {

/// All that candidates are held against.
struct PlanGround {
  const Cell& cell;
  const PlanOptions& options;
  std::vector<SurfaceSample> samples;
  ScanScene scene;
  CellSight sight;
  std::optional<RobotReach> reach;
};
[[nodiscard]] PlanGround plan_ground(const Cell& cell, const PlanOptions& options, std::uint64_t seed);

/// A viewpoint in a pose of the platform, and what it measures there.
struct AllowedView {
  std::uint32_t view = 0, pose = 0;
  std::vector<std::uint32_t> measures;  // samples, ascending; not empty
  std::uint8_t scanner_targets = 0, platform_targets = 0;
};

/// One that the cell does not allow, and why.
struct ForbiddenView {
  std::uint32_t view = 0, pose = 0;
  LimitMask fails = 0;
};

using SampleBits = std::vector<std::uint64_t>;

/// Candidates and what becomes of them.
struct CandidateStudy {
  std::vector<Viewpoint> views;
  BitRows rows;          // by view: measured, past part and fixtures
  SampleBits reachable;  // by any view that keeps clear of the part, were there nothing but the part
  SampleBits coverable;  // by any view that this cell allows
  SampleBits uncertain;  // by any that it allows, but less well known than the tolerance
  std::vector<AllowedView> allowed;
  std::vector<ForbiddenView> forbidden;
};

/// A view that measures something is tried in one pose of the platform after the other until the cell allows
/// it with all that it measures (`all_poses`: in each).
[[nodiscard]] CandidateStudy study_of(const PlanGround& ground, std::vector<Viewpoint> views, bool all_poses);
void append(CandidateStudy& study, CandidateStudy more);

/// The first candidates, by the options' method.
[[nodiscard]] std::vector<Viewpoint> first_views(const PlanGround& ground, std::uint64_t seed);

/// New candidates for places that stay uncovered: lines of sight of any incidence that is measured and any
/// distance within range, as many tried for each place as it takes to find three that see it past part and
/// fixtures and keep clear (Glorieux et al., RCIM 61 (2020) 101843, sample where it lacks, too).
[[nodiscard]] std::vector<Viewpoint> targeted_views(const PlanGround& ground,
                                                    std::span<const std::uint32_t> uncovered,
                                                    std::uint64_t seed);

/// All of it: the first candidates, then, round by round, more for what stays uncovered. Rings stay as they
/// are. `before`: samples that an earlier cloud measures.
[[nodiscard]] CandidateStudy study_candidates(const PlanGround& ground, std::span<const std::uint32_t> before,
                                              std::uint64_t seed, const Progress& progress);

}  // namespace asterism
