// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/measurement/frame.hpp"
#include "asterism/tracking/pose.hpp"
#include "asterism/tracking/view_matching.hpp"

// Which targets no longer stand where their body's file has them, from all frames of a run.

namespace asterism {

struct KnockOptions {
  double probability = 1e-6;   // of accusing a body whose targets all stand where they should
  double map_sigma_mm = 0.02;  // of a target's coordinates, each axis, where none is stated
  double decisive = 20;        // a target whose shift explains the run this much worse (χ²) is no rival
};
void describe(KnockOptions& options, OptionVisitor& visit);

struct KnockedTarget {
  int target = 0;                  // index into the body's targets
  Vec3 shift_mm = Vec3::Zero();    // from its place, in the body's frame
  Mat3 covariance = Mat3::Zero();  // mm²
  double chi_square = 0;           // by how much the run is better explained; three degrees of freedom
  std::vector<int> rivals;         // targets one of which may have moved in its place
  std::size_t seen = 0;            // frames in which both cameras saw it
  std::size_t excluded = 0;        // of these, frames whose pose refused it
};

/// What a run says of one body's shape.
struct ShapeCheck {
  std::vector<KnockedTarget> knocked;  // the most certain first; at most a third of the targets
  /// A shift this long of each target, in the direction that is hardest to see, would be found four times
  /// in five (Baarda's minimal detectable bias); infinite when the run cannot tell it at all.
  std::vector<double> detectable_mm;
  std::vector<double> detectable_at_once_mm;  // the same from one of the frames alone
  double misfit = 1;  // χ²/dof of the shape without the knocked: what map and noise leave unexplained
};

/// In each frame the views of a body's targets tell its shape once its pose is eliminated:
///
///   N = Σ Aᵀ W A − Aᵀ W J (Jᵀ W J)⁻¹ Jᵀ W A,   n likewise from the residuals,
///
/// A = ∂px/∂(targets in the body), J = ∂px/∂(pose). With the map's own covariance C the shift of a set S
/// of targets is that part of (N + C⁻¹)⁻¹ n with C infinite on S. Targets are accused one after the other
/// while the best explains the run better than chance would (data snooping over time; Baarda 1968), by an
/// F test where the others' own misfit exceeds what is stated. Views that the pose refused take part, and
/// points beside a target's place that nothing else explains (displaced_point).
[[nodiscard]] ShapeCheck check_shape(std::size_t body, std::span<const TrackedFrame> frames,
                                     const std::vector<Body>& bodies, const StereoRig& rig,
                                     const KnockOptions& options, const ViewOptions& views = {});

}  // namespace asterism
