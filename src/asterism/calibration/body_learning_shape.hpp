// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/calibration/body_learning_bundle.hpp"

namespace asterism {

/// The direction a disc faces and its size, from the ellipses it was seen as.
struct DiscShape {
  Vec3 normal;  // unit, in the body's frame, towards the cameras
  double radius_mm;
  double normal_sigma_rad;  // the larger of the two directions
  double radius_sigma_mm;
  double rms_px;  // of the semi-axes
};

enum class ShapeFailure { TooFewEllipses, NoDisc, Undetermined };

/// Fits the disc's normal and radius to the shapes of one target's images; positions and poses are held.
/// Each ellipse gives three numbers of like error (its mean radius, and its elongation along two
/// directions), weighted by its centre's variance and `shape_error_px`; Huber's loss. All of a hemisphere
/// is tried first: one image leaves two tilts open. NoDisc: the shapes are none a flat disc can have (a
/// sphere); Undetermined: the normal would be known to more than 10° only.
[[nodiscard]] Result<DiscShape, ShapeFailure> fit_disc_shape(const StereoRig& rig, const BodyModel& model,
                                                             std::size_t target,
                                                             const std::vector<BodyView>& views,
                                                             double shape_error_px);

}  // namespace asterism
