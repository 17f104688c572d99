// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/camera/lens.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

enum class Side { Left = 0, Right = 1 };

/// Two cameras fixed to each other. The frame `tracker` is the left camera: x right, y down, z forward.
struct StereoRig {
  Lens left, right;
  RigidMotion right_from_left;  // x_right = R x_left + T, mm

  /// Covariance of the parameters named in `covariance_order`, where calibration gave one. The names:
  /// fx1 fy1 skew1 cx1 cy1, the coefficients k1_1 k2_1 p1_1 …, the same with 2, then
  /// rx ry rz (rad) and tx ty tz (mm) of right_from_left's error (ω, δ) along the right camera's axes.
  MatX covariance;
  std::vector<std::string> covariance_order;

  [[nodiscard]] const Lens& lens(Side side) const { return side == Side::Left ? left : right; }
  [[nodiscard]] RigidMotion camera_from_tracker(Side side) const {
    return side == Side::Left ? RigidMotion{} : right_from_left;
  }
  [[nodiscard]] double baseline_mm() const { return right_from_left.translation.norm(); }
};

/// The names that `covariance_order` holds, for this rig's lenses.
[[nodiscard]] std::vector<std::string> rig_parameter_names(const StereoRig& rig);

/// ∂px / ∂(the rig's parameters), 2 × their number, of the image of a point in one camera.
/// `pixel_by_point` is ∂px / ∂(the point in that camera's frame).
[[nodiscard]] MatX pixel_by_rig(const StereoRig& rig, Side side, const Vec3& in_tracker,
                                const Mat23& pixel_by_point);

/// Throws InputError when a number is not finite, a focal length or the baseline not positive, the
/// rotation not one, an image size missing, the covariance not one of all parameters.
void check_rig(const StereoRig& rig, const std::string& where);

}  // namespace asterism
