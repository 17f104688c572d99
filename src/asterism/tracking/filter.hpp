// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "asterism/core/options.hpp"
#include "asterism/measurement/pose.hpp"

namespace asterism {

struct FilterOptions {
  double rate_wander_deg_s = 100;   // by how much the turning rate changes in one second (one sigma)
  double speed_wander_mm_s = 1000;  // the same of the speed
  double initial_rate_deg_s = 100;  // how fast a body may be turning when first seen
  double initial_speed_mm_s = 1000;
  double gate_probability = 1e-6;  // of refusing a pose that fits the motion
  double coast_max_s = 0.5;        // how long a body that is not seen is carried on
};
void describe(FilterOptions& options, OptionVisitor& visit);

/// One body's pose over time: an error-state Kalman filter on SE(3) with constant twist (motion_model.hpp).
///
/// A pose that does not fit the motion (its innovation beyond the gate) is left out once; when the next one
/// does not fit either, the motion was wrong and the filter starts again. A body that is not seen is
/// PREDICTED, its covariance growing, for `coast_max_s`, then LOST. What of a pose's covariance is systematic
/// is not averaged: the filter works on the rest and adds it back.
class PoseFilter {
 public:
  explicit PoseFilter(const FilterOptions& options);
  ~PoseFilter();
  PoseFilter(PoseFilter&&) noexcept;
  PoseFilter& operator=(PoseFilter&&) noexcept;

  /// Where the body should be at `time_s`; empty when it is lost.
  [[nodiscard]] std::optional<PoseEstimate> predict(double time_s) const;

  /// Takes in what a frame measured (or that it measured nothing). Times must not go back.
  [[nodiscard]] BodyPose update(double time_s, const BodyPose& measured);

 private:
  struct Memory;
  FilterOptions options_;
  std::unique_ptr<Memory> memory_;  // empty: the body is lost
  int misfits_ = 0;
};

}  // namespace asterism
