// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/io/recording.hpp"
#include "asterism/tracking/knocked_targets.hpp"
#include "asterism/tracking/tracker.hpp"

namespace asterism {

struct TrackJob {
  std::filesystem::path out;  // folder for the results
  TrackerOptions options;
  bool covariance = false;  // poses.json too: full covariances
  bool tum = false;         // NAME.tum too: a trajectory a body
};

/// An image that could not be read: that camera counts as having lost the frame.
struct UnreadableImage {
  int frame = 0;
  Side side = Side::Left;
  std::string why;
};

/// Where the time went.
struct TrackSeconds {
  double waiting_for_images = 0;  // they are read ahead while the frame before is tracked
  double tracking = 0;
  double smoothing = 0;
  double writing = 0;
  double total = 0;
};

struct TrackedRun {
  std::vector<Body> bodies;
  std::vector<TrackedFrame> frames;
  std::vector<std::vector<BodyPose>> smoothed;  // one row a frame, one pose a body
  std::vector<ShapeCheck> shapes;               // one a body: which of its targets were knocked
  std::vector<UnreadableImage> unreadable;
  std::vector<std::string> warnings;
  std::map<std::string, int> pose_failures;  // reasons why a body that was found got no pose
  TrackSeconds seconds;
};

/// Tracks all frames of a recording and writes into the job's folder centres.csv, points.csv, poses.csv,
/// poses_filtered.csv, poses_smoothed.csv and summary.json, row by row: when the work breaks off, what was
/// measured stays in NAME.partial. A frame whose image cannot be read does not stop it.
/// Throws InputError for a recording without rig or bodies, of another image size than the rig's, with no
/// body that could be tracked, or without one readable image.
[[nodiscard]] TrackedRun track_recording(const Recording& recording, const TrackJob& job,
                                         const Progress& progress);

/// "target `P3` of body `platform` has moved by 1.00 mm: (0.60, -0.50, 0.62) ± (0.01, 0.01, 0.02) mm, left
/// out in 98 % of 120 frames; …"
[[nodiscard]] std::string words_of(const KnockedTarget& knocked, const Body& body);

/// What summary.json holds: counts of statuses by body, residuals, targets refused and knocked, reasons,
/// times, the effective options.
[[nodiscard]] nlohmann::ordered_json summary_of(const TrackedRun& run, const TrackerOptions& options);

}  // namespace asterism
