// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "asterism/accuracy/accuracy_options.hpp"
#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/core/result.hpp"
#include "asterism/visibility/visibility.hpp"

namespace asterism {

/// NotDetermined: the views leave a motion free, as targets on one line do, or the rotation is known less
/// well than `max_sigma_deg`. BehindCamera: a target that is said to be seen lies behind its camera.
enum class AccuracyFailure { NotDetermined, BehindCamera };

/// Of a pose tracker_from_body: ω (rad), δ (mm) at the body's origin, along the tracker's axes
/// (geometry/rigid_motion.hpp; `covariance_of_point` gives it at any point of the body).
struct PoseAccuracy {
  Mat6 covariance;  // the whole of it
  Mat6 systematic;  // the share that frames have in common: the map's error and the rig's
};

/// The Cramér–Rao bound of a pose: Σ over the views of Jᵀ Σ⁻¹ J with J = ∂px/∂(ω, δ), 2 × 6, of the exact
/// image of each disc. A target's own covariance is common to its views. `seen` says which camera sees
/// which target.
[[nodiscard]] Result<Mat6, AccuracyFailure> pose_information(std::span<const Target> targets,
                                                             const std::array<TargetMask, 2>& seen,
                                                             const RigidMotion& tracker_from_body,
                                                             const StereoRig& rig,
                                                             const AccuracyOptions& options);

/// Its inverse; with the rig's own covariance, where it is known, added: the rig's parameters move the
/// estimate by C Σ Jᵀ W ∂px/∂(rig).
[[nodiscard]] Result<PoseAccuracy, AccuracyFailure> predict_pose_accuracy(
    std::span<const Target> targets, const std::array<TargetMask, 2>& seen,
    const RigidMotion& tracker_from_body, const StereoRig& rig, const AccuracyOptions& options);

/// Covariance (mm²) of a point that both cameras see, from centres known to `sigma_px`: for parallel cameras
/// σ_z = √2 σ z² / (b f) along the axis, σ z / (√2 f) across it.
[[nodiscard]] Result<Mat3, AccuracyFailure> predict_point_covariance(const Vec3& in_tracker,
                                                                     const StereoRig& rig, double sigma_px);

/// √tr of the covariance of a point fixed in the body, mm.
[[nodiscard]] double error_at_point_mm(const RigidMotion& tracker_from_body, const Mat6& covariance,
                                       const Vec3& in_body);

}  // namespace asterism
