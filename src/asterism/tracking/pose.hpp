// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"
#include "asterism/measurement/pose.hpp"

namespace asterism {

/// One target's image in one camera.
struct TargetView {
  int target = 0;  // index into the body's targets
  Side side = Side::Left;
  Vec2 px = Vec2::Zero();              // centre of the elliptical image
  Mat2 covariance = Mat2::Identity();  // px²
};

struct PoseOptions {
  double sigma_floor_px = 0.0005;     // added in quadrature to each view: no centre is better than this
  double model_error_px = 0.3;        // residuals that an imperfect rig or body may cause
  double outlier_probability = 1e-4;  // of rejecting a good target
  double max_sigma_deg = 1.0;
  double max_sigma_mm = 10.0;
  double max_incidence_deg = 90.0;
  int max_iterations = 30;
};
void describe(PoseOptions& options, OptionVisitor& visit);

/// TooFewViews: fewer than four views, or fewer than three targets. NotDetermined: the views leave a motion
/// free, as targets on one line do. NoConvergence: no minimum found. BehindCamera: a target would lie behind
/// the camera that saw it. FacesAway: a target would face away from it. Inconsistent: what remains after
/// rejecting the worst still does not fit. Ambiguous: another pose fits as well.
enum class PoseFailure {
  TooFewViews,
  NotDetermined,
  NoConvergence,
  BehindCamera,
  FacesAway,
  Inconsistent,
  Ambiguous
};
constexpr std::size_t kPoseFailures = 7;

struct PoseSolution {
  PoseEstimate estimate;
  double rms_px = 0;           // of the residuals of the views used, per axis
  double chi_square = 0;       // of the same, by their covariances
  int degrees_of_freedom = 0;  // of chi_square
  double variance_factor = 1;  // by which the covariance was widened since the residuals are too large
  std::vector<int> rejected;   // indices into the views; ascending
};

/// The pose under which the views are most likely: Gauss–Newton on the reprojection of all views of both
/// cameras through the exact image of each disc (camera/disc_image.hpp), targets seen by one camera included.
///
///   min over (R, t) of Σ rᵀ Σ⁻¹ r,   r = px − image(R p + t, R n),   covariance (Jᵀ Σ⁻¹ J)⁻¹
///
/// A body target's position covariance enters each view of it, both views of one target jointly. The rig's
/// covariance, where known, is added to the pose's. When χ² is too large, the target that stands out by an
/// F test against the others is rejected (data snooping; Baarda 1968), the rest refitted, and each of its
/// views taken back if it fits after all. What is left over as unmodelled error widens the covariance by
/// χ²/dof; beyond `model_error_px` the pose is refused.
[[nodiscard]] Result<PoseSolution, PoseFailure> estimate_pose(const Body& body,
                                                              std::span<const TargetView> views,
                                                              const StereoRig& rig, const RigidMotion& start,
                                                              const PoseOptions& options);

}  // namespace asterism
