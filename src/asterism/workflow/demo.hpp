// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/evaluation/pose_errors.hpp"
#include "asterism/workflow/simulate_recording.hpp"
#include "asterism/workflow/track_recording.hpp"
#include "asterism/workflow/verify_cell.hpp"

namespace asterism {

struct DemoJob {
  std::filesystem::path out;
  bool quick = false;  // a fifth of the frames, few disturbances, no faults
  std::uint64_t seed = 1;
};

struct DemoResult {
  std::string cell;
  SimulatedRecording simulated;
  TrackedRun tracked;
  std::vector<PoseErrors> errors;  // at each body's target centroid
  std::vector<Vec3> at_mm;         // those centroids, in the bodies' frames
  CellVerdict verdict;             // of the cell in motion
  double simulating_s = 0, tracking_s = 0, verifying_s = 0;
  std::filesystem::path report;         // the cell in motion
  std::filesystem::path tracking_page;  // the recording, frame by frame
};

/// The whole story on the built-in cell: it is simulated to images with known truth (OUT/recording), tracked
/// from these files as a user's would be and held against the truth (OUT/track, with a page of its own); then
/// the cell is verified along its motion and told in OUT/report.html.
[[nodiscard]] DemoResult run_demo(const DemoJob& job, const Progress& progress);

}  // namespace asterism
