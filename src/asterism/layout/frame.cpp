// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/frame.hpp"

#include "asterism/geometry/point_sets.hpp"

namespace asterism {

Result<RigidMotion, RigidFitFailure> three_point_frame(std::span<const Vec3> targets) {
  if (targets.size() < 3) return because(RigidFitFailure::TooFewPoints);
  return frame_from_three_points(targets[0], targets[1], targets[2]);
}

Result<RigidMotion, RigidFitFailure> centroid_frame(std::span<const Vec3> targets, CentroidAxes axes) {
  if (targets.size() < 3) return because(RigidFitFailure::TooFewPoints);
  const Vec3 centroid = centroid_of(targets);

  auto frame = axes == CentroidAxes::BetweenTargets
                   ? frame_from_three_points(targets[0], targets[1], targets[2])
                   : frame_from_three_points(centroid, targets[1], targets[0]);
  if (frame) frame->translation = centroid;
  return frame;
}

std::vector<Vec3> local_coordinates(const RigidMotion& body_from_local, std::span<const Vec3> targets) {
  const RigidMotion local_from_body = body_from_local.inverse();
  std::vector<Vec3> local;
  local.reserve(targets.size());
  for (const Vec3& target : targets) local.push_back(local_from_body * target);
  return local;
}

Mat3 axes_as_printed(std::span<const Vec3> targets) {
  require(targets.size() >= 3, "the printed matrix is made of three targets");
  const Vec3 v1 = targets[1] - targets[0];
  const Vec3 v2 = targets[2] - targets[0];
  Mat3 printed;
  printed << v1.normalized(), v2.normalized(), v1.cross(v2).normalized();
  return printed;
}

}  // namespace asterism
