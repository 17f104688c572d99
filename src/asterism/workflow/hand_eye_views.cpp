// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/hand_eye_views.hpp"

#include <fmt/format.h>

#include <map>

#include "asterism/core/result.hpp"
#include "asterism/io/pose_table.hpp"

namespace asterism {

std::vector<HandEyeView> hand_eye_views(const HandEyeJob& job) {
  const std::vector<PoseRecord> tracked = read_poses(job.poses);
  const auto artefact = poses_by_frame(read_poses(job.artefact), "", job.stated, job.artefact);
  const auto scanner = poses_by_frame(tracked, job.body, job.stated, job.poses);
  std::map<int, KnownMotion> reference;
  if (!job.reference.empty()) reference = poses_by_frame(tracked, job.reference, job.stated, job.poses);
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
