// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/scanning/scan_plan.hpp"

namespace asterism {

/// How the platform may be turned: a lattice of `steps` (odd) attitudes an axis within its stroke, its rest
/// first, then by how far they are from it. Without a platform: the one pose in which it all stands.
[[nodiscard]] std::vector<PlatformPose> platform_poses(const Cell& cell, int steps);

/// Where the part is when the platform is so turned; a part that the platform does not carry stays.
[[nodiscard]] RigidMotion tracker_from_workpiece(const Cell& cell, const PlatformPose& pose);

}  // namespace asterism
