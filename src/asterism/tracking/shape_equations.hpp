// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/measurement/frame.hpp"
#include "asterism/tracking/pose.hpp"
#include "asterism/tracking/view_matching.hpp"

// What the frames of a run say of a body's shape, whatever its pose was (knocked_targets.hpp).

namespace asterism {

/// Targets that both cameras saw in one frame.
struct SeenShape {
  RigidMotion tracker_from_body;  // about where the body is
  std::vector<TargetView> views;  // both of each target
};

/// The frames of a run in which a body has a pose, or labels that would have given one. A target without a
/// label takes part where one free point alone stands beside its place, and does so in a tenth of the
/// frames within 3 mm of where it mostly stands: what strays is a ghost.
[[nodiscard]] std::vector<SeenShape> seen_shapes(std::size_t body_index, std::span<const TrackedFrame> frames,
                                                 const Body& body, const ViewOptions& options);

/// Normal equations of the targets' shifts from their places, 3 a target along the body's axes.
struct ShapeEquations {
  MatX normal;                           // N
  VecX gradient;                         // n
  double shape_chi_square = 0;           // nᵀ N⁺ n: gained when each target may stand anywhere
  std::vector<std::size_t> frames_seen;  // a target
  std::size_t frames = 0;
};

/// Linearised where the targets are shifted by `about` (mm, 3 a target), told as shifts from their places.
[[nodiscard]] ShapeEquations shape_equations(std::span<const SeenShape> seen, const Body& body,
                                             const StereoRig& rig, const VecX& about);

}  // namespace asterism
