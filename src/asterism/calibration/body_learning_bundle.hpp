// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/measurement/centre.hpp"

namespace asterism {

/// One target seen in one image.
struct BodyView {
  std::size_t frame = 0;  // index into the poses
  std::size_t target = 0;
  Side side = Side::Left;
  Centre centre;
  bool rejected = false;  // far beyond what its covariance allows; takes no part
};

/// What the bundle solves for: coordinates and poses; normals and radii are held, by `fit_shapes`.
struct BodyModel {
  std::vector<Vec3> positions;               // mm, in the body's frame
  std::vector<std::optional<Vec3>> normals;  // unit
  std::vector<double> radii_mm;              // 0 = a point
  std::vector<RigidMotion> tracker_from_body;
};

struct BundleSummary {
  MatX covariance;  // mm², 3N × 3N: the centroid and the mean rotation of the targets held
  std::vector<Mat6> pose_covariances;
  double variance_factor = 1;  // χ² per degree of freedom
  double rms_px = 0;           // per axis, of the views not rejected
  int rejected = 0;
};

enum class BundleFailure { TooFewViews, Singular };

/// The image of a target's centre expected in one camera, and its slopes.
struct ExpectedView {
  Vec2 px;
  Mat23 by_position;  // ∂px / ∂ position in the body's frame
  Mat26 by_pose;      // ∂px / ∂ (ω, δ) of tracker_from_body
};
[[nodiscard]] Result<ExpectedView, LensFailure> expect_view(const StereoRig& rig, const BodyModel& model,
                                                            std::size_t frame, std::size_t target, Side side);

/// Maximum likelihood of all coordinates and poses given the centres' covariances: Levenberg–Marquardt on
/// the Schur complement (one 6×6 block a frame), Huber's loss, then refusal of what lies beyond five
/// robust sigmas, and a last plain fit. Covariance scaled by χ²/dof where that exceeds one; the rig's own
/// covariance is carried through where it is known.
[[nodiscard]] Result<BundleSummary, BundleFailure> bundle_body(const StereoRig& rig, BodyModel& model,
                                                               std::vector<BodyView>& views);

}  // namespace asterism
