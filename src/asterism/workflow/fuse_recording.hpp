// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asterism/tracking/fused_filter.hpp"
#include "asterism/workflow/track_recording.hpp"

namespace asterism {

/// What a user asks for.
struct FuseRequest {
  std::filesystem::path readings;   // the platform's read-out, a CSV file (io/reading_table.hpp)
  std::string body;                 // which it turns; empty = the first
  std::optional<double> latency_s;  // known; else it is told from the run
  double correlation_s = 0;         // for which the readings' noise keeps its value
};

/// The same, read and checked: before hours are spent on tracking.
struct FuseJob {
  std::string where;     // the file
  std::size_t body = 0;  // index into the recording's
  std::vector<PlatformReading> readings;
  std::optional<double> latency_s;
  double correlation_s = 0;
};
/// Throws InputError for a file that cannot be read or a body that is not there.
[[nodiscard]] FuseJob fuse_job_of(const FuseRequest& request, const std::vector<Body>& bodies);

struct FusedRecording {
  std::string body;
  std::optional<TimeOffset> offset;  // when it was told from the run
  double latency_s = 0, latency_sigma_s = 0;
  std::vector<BodyPose> poses;  // one a frame
};

/// Puts what the platform says of itself into the filter beside the tracker's poses and writes
/// poses_fused.csv and fusion.json into `out`. Throws MeasurementError when the run does not tell the
/// latency: why, and that it can be given.
[[nodiscard]] FusedRecording fuse_recording(const TrackedRun& run, const FuseJob& job,
                                            const FilterOptions& motion, const std::filesystem::path& out);

/// What fusion.json holds.
[[nodiscard]] nlohmann::ordered_json summary_of(const FusedRecording& fusion);

}  // namespace asterism
