// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "asterism/visibility/occlusion.hpp"

namespace asterism {

/// Why a camera does not see a target at a moment; nothing in it: it does.
struct SightCause {
  std::optional<SightFailure> fails;  // the first condition that does not hold
  std::optional<std::size_t> solid;   // with SightFailure::Hidden: which, a place in Occlusion::names()
  [[nodiscard]] bool seen() const { return !fails; }
};

/// One body's targets before both cameras over the motion.
struct WatchedBody {
  MotionVisibility visibility;                                 // all conditions, occlusion included
  std::vector<std::vector<std::array<SightCause, 2>>> causes;  // [pose][target][side]
};

/// A cell in motion as the tracker will see it.
struct WatchedCell {
  std::vector<double> times_s;
  std::vector<std::vector<RigidMotion>> poses;  // [pose][mover], tracker_from_body
  std::vector<WatchedBody> bodies;              // one a mover
  std::vector<double> coverage;                 // by pose, at the centroid of the platform's targets; empty
                                                // without a platform
};

/// Every target of every body at each of these moments. The volume is the cell's.
[[nodiscard]] WatchedCell watch_cell(const Cell& cell, std::span<const double> times_s,
                                     const VisibilityOptions& visibility, const Occlusion& occlusion);

/// The paper's field-of-view coverage coefficient (Fig. 20, undefined there; this reading fits it): cosine of
/// the angle between the platform's z and the way from its centre to the middle of the cameras; 0 when either
/// camera does not have that centre in its image or the working volume does not hold it.
[[nodiscard]] double coverage_coefficient(const Cell& cell, const RigidMotion& tracker_from_platform,
                                          const Vec3& centre_mm);

/// How often each solid hides each target, counted over the poses: [target][side][solid].
using HiddenCounts = std::vector<std::array<std::vector<int>, 2>>;
[[nodiscard]] HiddenCounts count_hidden(const WatchedBody& body, std::size_t solids);

/// A body's visible count over roll × pitch from its place of rest (Ry(pitch) Rx(roll)), about the pivot of
/// its sweep; of a body that moves otherwise, from where it begins and about its frame's origin. The other
/// bodies stand where they begin.
struct AttitudeMap {
  std::vector<double> roll_deg, pitch_deg;
  std::vector<std::vector<int>> visible;  // [pitch][roll]: targets both cameras see
  std::vector<std::vector<TargetMask>> seen_by_both;
  std::vector<RigidMotion> tracker_from_body;  // row by row: pitch by pitch, roll by roll
  MotionVisibility seen;                       // of the same poses
};
[[nodiscard]] AttitudeMap attitude_map(const Cell& cell, std::size_t mover, double reach_deg, int steps,
                                       const VisibilityOptions& visibility, const Occlusion& occlusion);

}  // namespace asterism
