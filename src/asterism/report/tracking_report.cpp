// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/tracking_report.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/report/page.hpp"
#include "asterism/report/page_json.hpp"
#include "asterism/report/sightings.hpp"

namespace asterism {
namespace {

using Json = nlohmann::json;

/// x y z, w x y z, covariance of `in_body` in the tracker (xx xy xz yy yz zz, mm²), of rotation (rad²).
Json of_pose(const BodyPose* pose, const Vec3& in_body) {
  if (pose == nullptr || !pose->estimate) return nullptr;
  const RigidMotion& motion = pose->estimate->tracker_from_body;
  const Mat6& covariance = pose->estimate->covariance;
  if (!is_finite(motion) || !covariance.allFinite()) return nullptr;
  Json row = Json::array();
  append_motion(row, motion);
  append_upper(row, covariance_of_point(motion, covariance, in_body));
  append_upper(row, covariance.topLeftCorner<3, 3>());
  return row;
}

Json of_motion(const std::optional<RigidMotion>& motion) {
  if (!motion || !is_finite(*motion)) return nullptr;
  return json_of_motion(*motion);
}

const BodyPose* pose_of(const std::vector<BodyPose>& poses, int body) {
  for (const BodyPose& pose : poses)
    if (pose.body == body) return &pose;
  return nullptr;
}

NamedPoint error_point(const TrackingReport& report, std::size_t body) {
  if (!report.error_points.empty()) return report.error_points[body];
  Vec3 sum = Vec3::Zero();
  const auto& targets = report.bodies[body].targets;
  for (const Target& target : targets) sum += target.position;
  return {"target centroid", sum / std::max<double>(1.0, static_cast<double>(targets.size()))};
}

/// By target: a character a frame (0 hidden, 1 left, 2 right, 3 both) and the residuals of each camera.
Json of_sightings(const TrackingReport& report, std::size_t body) {
  const auto& targets = report.bodies[body].targets;
  std::vector<std::string> seen(targets.size());
  std::vector<std::array<Json, 2>> residuals(targets.size(), {Json::array(), Json::array()});
  const auto of_residual = [](const std::optional<Vec2>& px) -> Json {
    if (!px || !px->allFinite()) return nullptr;
    return {decimals(px->x(), 4), decimals(px->y(), 4)};
  };
  for (const TrackedFrame& frame : report.frames) {
    const auto found = sightings(frame, report.bodies[body], static_cast<int>(body), report.rig);
    for (std::size_t i = 0; i < found.size(); ++i) {
      seen[i] += static_cast<char>('0' + (found[i].left_px ? 1 : 0) + (found[i].right_px ? 2 : 0));
      residuals[i][0].push_back(of_residual(found[i].left_px));
      residuals[i][1].push_back(of_residual(found[i].right_px));
    }
  }
  Json json = Json::array();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    json.push_back({{"seen", seen[i]}, {"left_px", residuals[i][0]}, {"right_px", residuals[i][1]}});
  }
  return json;
}

/// O = OK, P = PARTIAL, R = PREDICTED, A = AMBIGUOUS, L = LOST.
char letter_of(const BodyPose* pose) {
  constexpr std::string_view kLetters = "OPRAL";
  return pose == nullptr ? 'L' : kLetters[static_cast<std::size_t>(pose->status)];
}

Json of_body(const TrackingReport& report, std::size_t body) {
  const int index = static_cast<int>(body);
  const NamedPoint point = error_point(report, body);
  Json targets = Json::array();
  for (const Target& target : report.bodies[body].targets) targets.push_back(json_of_target(target));

  Json measured = Json::array(), filtered = Json::array(), used = Json::array(), rms = Json::array();
  std::string measured_status, filtered_status;
  bool any_filtered = false;
  for (const TrackedFrame& frame : report.frames) {
    const BodyPose* pose = pose_of(frame.poses, index);
    const BodyPose* smooth = pose_of(frame.filtered, index);
    any_filtered = any_filtered || smooth != nullptr;
    measured.push_back(of_pose(pose, point.in_body));
    filtered.push_back(of_pose(smooth, point.in_body));
    measured_status += letter_of(pose);
    filtered_status += letter_of(smooth);
    used.push_back(pose != nullptr ? pose->targets : 0);
    rms.push_back(pose != nullptr && pose->estimate ? decimals(pose->rms_px, 5) : Json(nullptr));
  }
  Json json = {{"name", report.bodies[body].name},
               {"targets", targets},
               {"point", {{"name", point.name}, {"position_mm", json_of(point.in_body)}}},
               {"status", measured_status},
               {"measured", measured},
               {"targets_used", used},
               {"rms_px", rms},
               {"sightings", of_sightings(report, body)}};
  if (any_filtered) {
    json["filtered_status"] = filtered_status;
    json["filtered"] = filtered;
  }
  if (!report.truth.empty()) {
    Json truth = Json::array();
    for (const auto& of_frame : report.truth) truth.push_back(of_motion(of_frame.at(body)));
    json["truth"] = truth;
  }
  return json;
}

}  // namespace

std::string tracking_report_json(const TrackingReport& report) {
  require(report.error_points.empty() || report.error_points.size() == report.bodies.size(),
          "a report has one error point a body, or none");
  require(report.truth.empty() || report.truth.size() == report.frames.size(),
          "a report has truth for every frame, or none");
  Json frame = Json::array(), time = Json::array(), left = Json::array(), right = Json::array();
  for (const TrackedFrame& tracked : report.frames) {
    frame.push_back(tracked.centres.frame);
    time.push_back(decimals(tracked.centres.time_s, 6));
    left.push_back(tracked.centres.left.size());
    right.push_back(tracked.centres.right.size());
  }
  Json bodies = Json::array();
  for (std::size_t i = 0; i < report.bodies.size(); ++i) bodies.push_back(of_body(report, i));
  const Json json = {
      {"schema", "asterism-tracking-report/1"},
      {"title", report.title},
      {"subtitle", report.subtitle},
      {"summary", json_of_summary(report.summary)},
      {"remarks", report.remarks},
      {"rig", json_of_rig(report.rig)},
      {"frames", {{"frame", frame}, {"time_s", time}, {"centres_left", left}, {"centres_right", right}}},
      {"bodies", bodies},
      {"options", json_of_stored(report.options_json)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_report(const std::filesystem::path& path, const TrackingReport& report) {
  write_file(path, page_with_data(report_page(), tracking_report_json(report)));
}

}  // namespace asterism
