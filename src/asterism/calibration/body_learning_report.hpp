// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/calibration/body_learning.hpp"
#include "asterism/calibration/body_learning_bundle.hpp"
#include "asterism/calibration/body_learning_frame.hpp"
#include "asterism/calibration/body_learning_shape.hpp"

namespace asterism {

/// What the bundle and the fits of the shapes made of a set, in the set's frame and order.
struct AdjustedBody {
  BodyModel model;
  std::vector<BodyView> views;
  BundleSummary summary;
  std::vector<Result<DiscShape, ShapeFailure>> shapes;
};

/// The body told in its frame, with the quality of its targets and with warnings of what is poorly known.
/// The ambiguity is left to the caller.
[[nodiscard]] LearntBody report_body(const StereoRig& rig, AdjustedBody adjusted, const BodyFrame& frame,
                                     const std::string& name, std::size_t frames_given);

}  // namespace asterism
