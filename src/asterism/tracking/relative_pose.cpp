// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/relative_pose.hpp"

namespace asterism {

PoseEstimate relative_pose(const PoseEstimate& tracker_from_a, const PoseEstimate& tracker_from_b) {
  const RigidMotion a_from_tracker = tracker_from_a.tracker_from_body.inverse();
  const RigidMotion& b = tracker_from_b.tracker_from_body;
  const auto joint = [&](const Mat6& of_a, const Mat6& of_b) {
    return covariance_of_product(a_from_tracker,
                                 covariance_of_inverse(tracker_from_a.tracker_from_body, of_a), b, of_b);
  };
  PoseEstimate relative;
  relative.tracker_from_body = a_from_tracker * b;
  relative.covariance = joint(tracker_from_a.covariance, tracker_from_b.covariance);
  relative.systematic = joint(tracker_from_a.systematic, tracker_from_b.systematic);
  return relative;
}

}  // namespace asterism
