// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/fuse_recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "asterism/io/pose_table.hpp"
#include "asterism/io/reading_table.hpp"

namespace asterism {
namespace {

std::size_t body_named(const std::string& name, const std::vector<Body>& bodies) {
  if (name.empty()) return 0;
  std::vector<std::string> names;
  for (const Body& body : bodies) names.push_back(body.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string nearest = nearest_name(name, names);
  throw InputError(fmt::format("`{}` is no body of the recording; {}", name,
                               nearest.empty() ? fmt::format("known are: {}", fmt::join(names, ", "))
                                               : fmt::format("did you mean `{}`?", nearest)));
}

std::vector<TimedPose> poses_of(const TrackedRun& run, std::size_t body) {
  std::vector<TimedPose> poses;
  for (const TrackedFrame& frame : run.frames) poses.push_back({frame.centres.time_s, frame.poses[body]});
  return poses;
}

TimeOffset told_offset(const std::vector<TimedPose>& tracked, const FuseJob& job) {
  TimeOffsetOptions search;
  search.correlation_s = job.correlation_s;
  const auto offset = estimate_time_offset(tracked, job.readings, search);
  if (offset) return *offset;
  throw MeasurementError(fmt::format("{}: {}; where it is known, give it with --read-out-latency", job.where,
                                     text_of(offset.error())));
}

}  // namespace

FuseJob fuse_job_of(const FuseRequest& request, const std::vector<Body>& bodies) {
  FuseJob job{request.readings.string(), body_named(request.body, bodies), read_readings(request.readings),
              request.latency_s, request.correlation_s};
  if (job.correlation_s > 0) {
    for (PlatformReading& reading : job.readings) reading.correlated = reading.covariance;
  }
  return job;
}

FusedRecording fuse_recording(const TrackedRun& run, const FuseJob& job, const FilterOptions& motion,
                              const std::filesystem::path& out) {
  const std::size_t body = job.body;
  const std::vector<TimedPose> tracked = poses_of(run, body);
  FusedRecording fusion;
  fusion.body = run.bodies[body].name;
  if (job.latency_s) {
    fusion.latency_s = *job.latency_s;
  } else {
    fusion.offset = told_offset(tracked, job);
    fusion.latency_s = fusion.offset->latency_s;
    fusion.latency_sigma_s = fusion.offset->sigma_s;
  }
  FusedOptions options;
  options.latency_s = fusion.latency_s;
  options.latency_sigma_s = fusion.latency_sigma_s;
  options.correlation_s = job.correlation_s;
  fusion.poses = fused(tracked, job.readings, options, motion);

  PoseTable table(out / "poses_fused.csv");
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    BodyPose pose = fusion.poses[i];
    pose.body = static_cast<int>(body);
    table.write(record_of(run.frames[i].centres.frame, tracked[i].time_s, pose, run.bodies));
  }
  table.finish();
  write_file(out / "fusion.json", summary_of(fusion).dump(2) + "\n");
  return fusion;
}

nlohmann::ordered_json summary_of(const FusedRecording& fusion) {
  nlohmann::ordered_json json = {{"body", fusion.body},
                                 {"latency_s", fusion.latency_s},
                                 {"latency_sigma_s", fusion.latency_sigma_s},
                                 {"latency_told_from_run", fusion.offset.has_value()}};
  if (fusion.offset) {
    const RigidMotion& base = fusion.offset->tracker_from_base;
    const Quaternion& q = base.rotation;
    const Vec6 sigma = fusion.offset->covariance.diagonal().cwiseSqrt();
    json["tracker_from_base"] = {
        {"translation_mm", {base.translation.x(), base.translation.y(), base.translation.z()}},
        {"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}},
        {"sigma_mm", {sigma(3), sigma(4), sigma(5)}},
        {"sigma_deg", {deg_from_rad(sigma(0)), deg_from_rad(sigma(1)), deg_from_rad(sigma(2))}}};
    json["readings"] = fusion.offset->readings;
    json["readings_refused"] = fusion.offset->refused;
    json["misfit"] = fusion.offset->misfit;
  }
  auto& counts = json["status"] = nlohmann::ordered_json::object();
  for (const PoseStatus status : {PoseStatus::Ok, PoseStatus::Partial, PoseStatus::Predicted,
                                  PoseStatus::Ambiguous, PoseStatus::Lost}) {
    counts[std::string(text_of(status))] =
        std::count_if(fusion.poses.begin(), fusion.poses.end(),
                      [&](const BodyPose& pose) { return pose.status == status; });
  }
  return json;
}

}  // namespace asterism
