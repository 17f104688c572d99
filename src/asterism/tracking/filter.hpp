// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/tracking/motion_model.hpp"

namespace asterism {

/// One body's pose over time: an error-state Kalman filter on SE(3) with constant twist (motion_model.hpp).
///
/// A pose that does not fit the motion (its innovation beyond the gate) is left out once; when the next one
/// does not fit either, the motion was wrong and the filter starts again. In between either may be wrong, so
/// the prediction's covariance is widened until it holds the pose that contradicts it. A body that is not
/// seen is PREDICTED, its covariance growing, for `coast_max_s`, then LOST. What of a pose's covariance is
/// systematic is not averaged: the filter works on the rest and adds it back.
class PoseFilter {
 public:
  explicit PoseFilter(const FilterOptions& options) : options_(options) {}

  /// Where the body should be at `time_s`; empty when it is lost.
  [[nodiscard]] std::optional<PoseEstimate> predict(double time_s) const;

  /// Takes in what a frame measured (or that it measured nothing). Times must not go back.
  [[nodiscard]] BodyPose update(double time_s, const BodyPose& measured);

 private:
  /// The state after the last pose taken in, and what of its covariance does not average out.
  struct Memory {
    MotionState state;
    Mat6 systematic;
    bool fresh;  // one pose alone: the twist is not known yet
  };
  FilterOptions options_;
  std::optional<Memory> memory_;  // empty: the body is lost
  int misfits_ = 0;
  double doubt_ = 1;  // by which a prediction's covariance is widened while a pose contradicts the motion
};

}  // namespace asterism
