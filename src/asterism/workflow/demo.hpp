// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/evaluation/pose_errors.hpp"
#include "asterism/report/summary_row.hpp"
#include "asterism/workflow/scan_story.hpp"
#include "asterism/workflow/simulate_recording.hpp"
#include "asterism/workflow/track_recording.hpp"
#include "asterism/workflow/verify_cell.hpp"

namespace asterism {

struct DemoJob {
  std::filesystem::path out;
  bool quick = false;  // a fifth of the frames, few disturbances, no faults, a coarser plan
  std::uint64_t seed = 1;
};

struct DemoResult {
  std::string cell;
  SimulatedRecording simulated;
  TrackedRun tracked;
  std::vector<PoseErrors> errors;  // at each body's target centroid
  std::vector<Vec3> at_mm;         // those centroids, in the bodies' frames
  CellVerdict verdict;             // of the cell in motion
  std::size_t layouts = 0;         // on the front of the search
  std::vector<ScanRound> scans;
  std::vector<SummaryRow> summary;  // the paper's headline figures beside ours
  double simulating_s = 0, tracking_s = 0, verifying_s = 0, scanning_s = 0;
  std::filesystem::path report;         // plan, scans and cloud; leads to the others
  std::filesystem::path cell_page;      // the cell in motion
  std::filesystem::path layout_page;    // where the targets should go
  std::filesystem::path tracking_page;  // the recording, frame by frame
};

/// The whole story of the paper's Fig. 16 on the built-in cell: where the targets should go (OUT/layout); a
/// dynamic scan simulated to images with known truth (OUT/recording), tracked from these files as a user's
/// would be and held against the truth (OUT/track); the cell verified along its motion (OUT/verify); then
/// views planned, scanned, fused, and what is missing planned and scanned anew with the platform turned
/// (scan_story.hpp). OUT/report.html tells of plan and cloud and leads to the other pages.
[[nodiscard]] DemoResult run_demo(const DemoJob& job, const Progress& progress);

}  // namespace asterism
