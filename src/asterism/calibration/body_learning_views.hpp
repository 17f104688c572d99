// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/calibration/body_learning_bundle.hpp"
#include "asterism/calibration/body_learning_growth.hpp"

namespace asterism {

/// The views of all frames in which the set was found, those of a single camera too: each centre goes to
/// the nearest target that the model expects within `gate_px` of it. A frame with fewer than four views,
/// and centres whose ellipse is not the whole disc's, are left out. The model has one pose a sighting.
[[nodiscard]] std::vector<BodyView> views_of(const StereoRig& rig, const BodyModel& model,
                                             const RigidSet& set, std::span<const ObservedFrame> frames,
                                             double gate_px);

}  // namespace asterism
