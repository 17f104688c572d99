// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/calibration/body_learning_bundle.hpp"
#include "asterism/cell/body.hpp"

namespace asterism {

/// Which frame a learnt body's coordinates are told in, and in which order its targets come.
struct BodyFrame {
  RigidMotion body_from_set;
  std::vector<std::size_t> order;  // of the learnt targets
  std::vector<std::string> ids;    // in that order
  double rms_mm = 0;               // of the fit onto nominal coordinates
  double second_rms_mm = 0;        // of the next best way to lay it there; 0 = there is none
};

/// Origin in the centroid, z the direction of the targets' least spread, towards the cameras, x towards the
/// target farthest from the centroid across z: T1; the others counter-clockwise as the cameras see them.
[[nodiscard]] BodyFrame own_frame(const StereoRig& rig, const BodyModel& model);

/// The nominal body's frame, order and ids. Empty when the learnt targets do not fit its coordinates to
/// `error_mm` each.
[[nodiscard]] std::optional<BodyFrame> nominal_frame(const BodyModel& model, const Body& nominal,
                                                     double error_mm);

/// The same body and poses told in another frame and order.
[[nodiscard]] BodyModel in_frame(const BodyModel& model, const BodyFrame& frame);
[[nodiscard]] MatX in_frame(const MatX& covariance, const BodyFrame& frame);

}  // namespace asterism
