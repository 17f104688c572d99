// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/camera/stereo_rig.hpp"

namespace asterism {

/// Where two sight lines meet, and how well.
struct TwoViewPoint {
  Vec3 in_tracker;           // mm
  Mat3 covariance;           // mm²
  double epipolar_error_px;  // signed, along the gradient of the epipolar constraint over both images
  double epipolar_sigma_px;  // what the centres' covariances let it be
};

enum class TwoViewFailure { LensFolds, RaysParallel, BehindCamera };

/// The point whose images are nearest to both pixels: Lindstrom's optimal correction (CVPR 2010) with
/// the covariances' anisotropy whitened out, then the intersection. Covariance by (Jᵀ W J)⁻¹; the rig's
/// own covariance, where known, is added. For parallel cameras this is the paper's z = b f / (x_L − x_R)
/// (Eqs. 1–4).
[[nodiscard]] Result<TwoViewPoint, TwoViewFailure> triangulate_pair(const StereoRig& rig, const Vec2& left_px,
                                                                    const Mat2& left_covariance,
                                                                    const Vec2& right_px,
                                                                    const Mat2& right_covariance);

}  // namespace asterism
