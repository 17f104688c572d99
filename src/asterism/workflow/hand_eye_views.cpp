// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/hand_eye_views.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "asterism/core/result.hpp"
#include "asterism/io/pose_table.hpp"

namespace asterism {
namespace {

struct Known {
  RigidMotion motion;
  Mat6 covariance;
};

Mat6 stated(const HandEyeJob& job) {
  Mat6 covariance = Mat6::Zero();
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(std::pow(rad_from_deg(job.sigma_deg), 2));
  covariance.bottomRightCorner<3, 3>().diagonal().setConstant(job.sigma_mm * job.sigma_mm);
  return covariance;
}

/// By frame, of one body, or of whatever a file tells of when it tells of one body alone.
std::map<int, Known> by_frame(const HandEyeJob& job, const std::filesystem::path& file,
                              const std::vector<PoseRecord>& records, const std::string& body) {
  std::map<int, Known> known;
  std::string of = body;
  for (const PoseRecord& record : records) {
    if (of.empty()) of = record.body;
    if (body.empty() && record.body != of)
      throw InputError(file.string(), "tells of several bodies; the artefact's poses alone are needed");
    if (record.body != of || !record.tracker_from_body) continue;
    known[record.frame] = {*record.tracker_from_body, record.covariance.value_or(stated(job))};
  }
  if (known.empty()) throw InputError(file.string(), fmt::format("tells no pose of body `{}`", of));
  return known;
}

}  // namespace

std::vector<HandEyeView> hand_eye_views(const HandEyeJob& job) {
  const std::vector<PoseRecord> tracked = read_poses(job.poses);
  const auto artefact = by_frame(job, job.artefact, read_poses(job.artefact), "");
  const auto scanner = by_frame(job, job.poses, tracked, job.body);
  std::map<int, Known> reference;
  if (!job.reference.empty()) reference = by_frame(job, job.poses, tracked, job.reference);
  std::vector<HandEyeView> views;
  for (const auto& [frame, seen] : artefact) {
    const auto body = scanner.find(frame);
    if (body == scanner.end()) continue;
    HandEyeView view{body->second.motion, body->second.covariance, seen.motion, seen.covariance};
    if (!job.reference.empty()) {
      const auto carrier = reference.find(frame);
      if (carrier == reference.end()) continue;
      const RigidMotion reference_from_tracker = carrier->second.motion.inverse();
      const Mat6 of_inverse = covariance_of_inverse(carrier->second.motion, carrier->second.covariance);
      view.of_body =
          covariance_of_product(reference_from_tracker, of_inverse, view.reference_from_body, view.of_body);
      view.reference_from_body = reference_from_tracker * view.reference_from_body;
    }
    views.push_back(view);
  }
  if (views.empty()) {
    throw InputError(job.artefact.string(),
                     fmt::format("none of its frames has a pose in {}", job.poses.string()));
  }
  return views;
}

}  // namespace asterism
