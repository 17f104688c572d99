// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/measurement/frame.hpp"
#include "asterism/tracking/motion_model.hpp"

namespace asterism {

/// The poses of a recorded run, each estimated from all frames: the filter's forward pass, then the
/// fixed-interval smoother of Rauch, Tung and Striebel (AIAA J. 3, 1965) back over it. One row a frame, one
/// pose a body. Frames that measured nothing stay as they are (LOST, AMBIGUOUS): nothing is invented. The run
/// is cut where a body was unseen for longer than `coast_max_s` or a pose does not fit the motion.
/// Throws InputError naming the frame when time goes back.
[[nodiscard]] std::vector<std::vector<BodyPose>> smooth(std::span<const TrackedFrame> frames,
                                                        const FilterOptions& options);

}  // namespace asterism
