// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/measurement/frame.hpp"
#include "asterism/report/summary_row.hpp"

namespace asterism {

/// A point of a body at which accuracy is told: the lever arm matters.
struct NamedPoint {
  std::string name;
  Vec3 in_body;  // mm
};

/// What one tracked recording came to. Whatever is empty is left out of the page.
struct TrackingReport {
  std::string title;
  std::string subtitle;              // one line: recording, program and version, seed
  std::vector<SummaryRow> summary;   // what was measured, how sure
  std::vector<std::string> remarks;  // what went wrong, in words
  StereoRig rig;
  std::vector<Body> bodies;
  std::vector<NamedPoint> error_points;  // one a body; none = the centroid of each body's targets
  std::vector<TrackedFrame> frames;
  /// tracker_from_body by frame, then body; none = no truth is known.
  std::vector<std::vector<std::optional<RigidMotion>>> truth;
  std::string options_json;  // the effective options; empty = none
};

/// The report's data as the page reads it (web/src/data/report.ts is the same list). Lengths mm, angles
/// of covariances rad, six decimals or digits; a number that is not finite becomes null.
[[nodiscard]] std::string tracking_report_json(const TrackingReport& report);

/// One HTML file that opens from disk, with everything inside. The file appears whole or not at all.
/// Throws InputError when it cannot be written.
void write_report(const std::filesystem::path& path, const TrackingReport& report);

}  // namespace asterism
