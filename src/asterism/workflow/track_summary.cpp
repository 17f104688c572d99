// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/io/options_file.hpp"
#include "asterism/workflow/track_recording.hpp"

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kStatuses = {PoseStatus::Ok, PoseStatus::Partial, PoseStatus::Predicted,
                                  PoseStatus::Ambiguous, PoseStatus::Lost};

/// How often each status came, of one body, in one of the rows of poses.
Json counts_of(const std::vector<const BodyPose*>& poses) {
  Json counts = Json::object();
  for (const PoseStatus status : kStatuses) {
    counts[std::string(text_of(status))] = std::count_if(
        poses.begin(), poses.end(), [&](const BodyPose* pose) { return pose->status == status; });
  }
  return counts;
}

/// Residuals and stated uncertainty of one body's measured poses, root mean square over the frames.
void add_quality(const std::vector<const BodyPose*>& poses, Json& json) {
  double rms = 0;
  Vec6 variance = Vec6::Zero();
  double targets = 0;
  double count = 0;
  for (const BodyPose* pose : poses) {
    if (!pose->estimate) continue;
    rms += pose->rms_px * pose->rms_px;
    variance += pose->estimate->covariance.diagonal();
    targets += pose->targets;
    ++count;
  }
  if (count == 0) return;
  const Vec6 sigma = (variance / count).cwiseSqrt();
  json["mean_targets"] = targets / count;
  json["rms_px"] = std::sqrt(rms / count);
  json["sigma_mm"] = {sigma(3), sigma(4), sigma(5)};
  json["sigma_deg"] = {deg_from_rad(sigma(0)), deg_from_rad(sigma(1)), deg_from_rad(sigma(2))};
}

Json body_summary(const TrackedRun& run, std::size_t body) {
  std::vector<const BodyPose*> measured, filtered;
  for (const TrackedFrame& frame : run.frames) {
    measured.push_back(&frame.poses.at(body));
    filtered.push_back(&frame.filtered.at(body));
  }
  Json json = {{"name", run.bodies[body].name},
               {"status", counts_of(measured)},
               {"status_filtered", counts_of(filtered)}};
  add_quality(measured, json);
  return json;
}

}  // namespace

Json summary_of(const TrackedRun& run, const TrackerOptions& options) {
  std::size_t centres = 0;
  std::size_t points = 0;
  for (const TrackedFrame& frame : run.frames) {
    centres += frame.centres.left.size() + frame.centres.right.size();
    points += frame.points.size();
  }
  Json json = {
      {"frames", run.frames.size()}, {"centres", centres}, {"points", points}, {"bodies", Json::array()}};
  for (std::size_t body = 0; body < run.bodies.size(); ++body)
    json["bodies"].push_back(body_summary(run, body));
  json["pose_failures"] = run.pose_failures;
  json["unreadable_images"] = Json::array();
  for (const UnreadableImage& image : run.unreadable) {
    json["unreadable_images"].push_back({{"frame", image.frame},
                                         {"camera", image.side == Side::Left ? "left" : "right"},
                                         {"why", image.why}});
  }
  json["warnings"] = run.warnings;
  json["seconds"] = {{"total", run.seconds.total},
                     {"waiting_for_images", run.seconds.waiting_for_images},
                     {"tracking", run.seconds.tracking},
                     {"smoothing", run.seconds.smoothing},
                     {"writing", run.seconds.writing}};
  TrackerOptions shown = options;
  json["options"] = json_of_options(describing(shown));
  return json;
}

}  // namespace asterism
