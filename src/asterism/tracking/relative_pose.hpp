// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/measurement/pose.hpp"

namespace asterism {

/// One body's pose in another's frame (dynamic referencing): a_from_b = tracker_from_a⁻¹ · tracker_from_b,
/// for example workpiece_from_scanner. The covariance is that of both poses, each with its lever arm: an
/// error of a's rotation moves b by its distance. Both errors are taken as independent, which is right for
/// what the centres contribute; the rig's own error is common to both and partly cancels, so its share is an
/// upper bound.
[[nodiscard]] PoseEstimate relative_pose(const PoseEstimate& tracker_from_a,
                                         const PoseEstimate& tracker_from_b);

}  // namespace asterism
