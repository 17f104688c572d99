// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/measurement/frame.hpp"

namespace asterism {

/// Where a camera found a target, less where the measured pose puts it (px); nothing where it did not.
struct Sighting {
  std::optional<Vec2> left_px, right_px;
};

/// How each target of `body` was seen in a frame, in the order of its targets. A target whose point was
/// labelled was seen by both cameras; of the others, a camera has seen those with a centre where the pose
/// puts them. Without a pose measured in this frame nothing counts as seen.
[[nodiscard]] std::vector<Sighting> sightings(const TrackedFrame& frame, const Body& body, int body_index,
                                              const StereoRig& rig);

}  // namespace asterism
