// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/core/progress.hpp"
#include "asterism/scanning/scan_plan.hpp"
#include "asterism/workflow/fuse_scans.hpp"

namespace asterism {

struct ScanStoryJob {
  std::filesystem::path out;
  bool quick = false;  // fewer samples and candidates
  std::uint64_t seed = 1;
};

/// One round of it: what was planned, carried out, and what the cloud held then.
struct ScanRound {
  std::string name;  // "platform at rest"
  ScanPlan plan;
  FusedScans fused;  // all scans so far
  double planning_s = 0, scanning_s = 0, fusing_s = 0;
};

/// The paper's Fig. 16 from the plan on: plan with the platform at rest → simulate scanner and tracker →
/// track → fuse → what is missing → plan the rest with the platform turned → scan again → fuse all. Every
/// step by the files a user's would go through: OUT/plan.json, OUT/scan/, OUT/rescan.json, OUT/rescan/,
/// OUT/cloud.ply. A cell whose part is covered at rest takes one round.
[[nodiscard]] std::vector<ScanRound> tell_scan_story(const Cell& cell, const ScanStoryJob& job,
                                                     const Progress& progress);

/// Stations on rings around the part in the same cell, the platform turned, as many as add anything: what the
/// paper scans with, for comparison. None where the tracker sees no such station.
[[nodiscard]] std::optional<ScanPlan> plan_on_rings(const Cell& cell, const ScanStoryJob& job,
                                                    const Progress& progress);

}  // namespace asterism
