// SPDX-License-Identifier: Apache-2.0
// One target seen by two cameras: where it is, and how well that is known.
#include <fmt/format.h>

#include "asterism/camera/two_view.hpp"
#include "asterism/cell/cell.hpp"

int main() {
  using namespace asterism;
  // Two cameras 1 m apart whose axes meet 2.3 m ahead; of your own: read_rig("rig.yaml") of io/rig_file.hpp.
  const StereoRig rig = rig_of({.width_px = 2048, .height_px = 1536, .focal_px = 3200});

  // What detection found: the target's centre in each image, each known to 0.02 px.
  const Vec2 left_px(1103.25, 700.40);
  const Vec2 right_px(1060.90, 699.87);
  const Mat2 covariance = Mat2::Identity() * (0.02 * 0.02);

  const auto point = triangulate_pair(rig, left_px, covariance, right_px, covariance);
  if (!point) {
    fmt::print("the sight lines do not meet\n");
    return 1;
  }
  const Vec3 sigma = point->covariance.diagonal().cwiseSqrt();
  fmt::print("target at ({:.3f}, {:.3f}, {:.3f}) mm from the left camera\n", point->in_tracker.x(),
             point->in_tracker.y(), point->in_tracker.z());
  fmt::print("sigma      {:.3f}  {:.3f}  {:.3f}  mm\n", sigma.x(), sigma.y(), sigma.z());
  fmt::print("the sight lines miss each other by {:.2f} px ({:.3f} px would be usual)\n",
             point->epipolar_error_px, point->epipolar_sigma_px);
  return 0;
}
