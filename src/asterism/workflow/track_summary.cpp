// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

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

/// Targets that poses refused, with how often; those that were knocked; how small a knock would be found.
void add_shape(const TrackedRun& run, std::size_t body, const std::vector<const BodyPose*>& poses,
               Json& json) {
  const std::vector<Target>& targets = run.bodies[body].targets;
  json["rejected"] = Json::object();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const auto times = std::count_if(poses.begin(), poses.end(), [&](const BodyPose* pose) {
      return std::binary_search(pose->rejected.begin(), pose->rejected.end(), static_cast<int>(t));
    });
    if (times > 0) json["rejected"][targets[t].id] = times;
  }
  if (body >= run.shapes.size()) return;
  const ShapeCheck& check = run.shapes[body];
  json["knocked"] = Json::array();
  for (const KnockedTarget& knocked : check.knocked) {
    const Vec3 sigma = knocked.covariance.diagonal().cwiseSqrt();
    Json rivals = Json::array();
    for (const int rival : knocked.rivals) rivals.push_back(targets[static_cast<std::size_t>(rival)].id);
    json["knocked"].push_back(
        {{"target", targets[static_cast<std::size_t>(knocked.target)].id},
         {"shift_mm", {knocked.shift_mm.x(), knocked.shift_mm.y(), knocked.shift_mm.z()}},
         {"sigma_mm", {sigma.x(), sigma.y(), sigma.z()}},
         {"rivals", rivals},
         {"seen", knocked.seen},
         {"excluded", knocked.excluded}});
  }
  Json detectable = Json::object();
  for (std::size_t t = 0; t < check.detectable_mm.size(); ++t) {
    if (std::isfinite(check.detectable_mm[t])) detectable[targets[t].id] = check.detectable_mm[t];
  }
  json["detectable_knock_mm"] = detectable;
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
  add_shape(run, body, measured, json);
  return json;
}

std::string triple(const Vec3& v) { return fmt::format("({:.3f}, {:.3f}, {:.3f})", v.x(), v.y(), v.z()); }

}  // namespace

std::string words_of(const KnockedTarget& knocked, const Body& body) {
  const auto id = [&](int target) { return body.targets[static_cast<std::size_t>(target)].id; };
  std::string which = fmt::format("target `{}`", id(knocked.target));
  for (const int rival : knocked.rivals) which += fmt::format(" or `{}`", id(rival));
  const double share = 100.0 * static_cast<double>(knocked.excluded) /
                       static_cast<double>(std::max<std::size_t>(1, knocked.seen));
  return fmt::format(
      "{} of body `{}` has moved by {:.2f} mm: {} ± {} mm, left out in {:.0f} % of {} frames; put it back or "
      "learn the body anew",
      which, body.name, knocked.shift_mm.norm(), triple(knocked.shift_mm),
      triple(knocked.covariance.diagonal().cwiseSqrt()), std::min(100.0, share), knocked.seen);
}

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
