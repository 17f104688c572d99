// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/camera/disc_image.hpp"
#include "asterism/camera/stereo_rig.hpp"

namespace asterism {

/// A board point as the forward model needs it: a corner, or a circle with its radius.
struct BoardMark {
  Vec3 in_board;  // mm
  double radius_mm = 0;
};

/// Where a mark is seen and how that changes. Motions by their errors (ω, δ) along the destination's axes.
struct MarkImage {
  Vec2 px;
  ParameterJacobian by_lens;
  Mat26 by_rig;    // of right_from_left; only for the right camera
  Mat26 by_board;  // of tracker_from_board
  Vec2 by_radius;  // circles
  Vec2 by_scale;   // of the board: ∂ / ∂ ln(pitch)
};

/// The exact image of a mark: of a corner its projection; of a circle the centre of its ellipse.
/// Empty when it lies behind the camera.
[[nodiscard]] std::optional<MarkImage> image_of_mark(const BoardMark& mark, Side side, const StereoRig& rig,
                                                     const RigidMotion& tracker_from_board);

}  // namespace asterism
