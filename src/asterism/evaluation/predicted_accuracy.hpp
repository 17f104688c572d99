// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/evaluation/verified_body.hpp"

namespace asterism {

/// What a body's pose will be worth at a named point, by frame.
struct PredictedPoint {
  WorkPoint point;
  std::vector<std::optional<Mat3>> covariance;  // mm², along the tracker's axes; none: not determined

  /// √tr Σ, mm.
  [[nodiscard]] std::optional<double> error_mm(std::size_t frame) const;
};

/// The Cramér–Rao bound of a body's pose along a motion.
struct PredictedAccuracy {
  std::vector<std::optional<PoseAccuracy>> poses;  // by frame; none: not determined
  std::vector<PredictedPoint> points;
  std::size_t undetermined = 0;  // frames

  /// √tr of the rotation's covariance, deg.
  [[nodiscard]] std::optional<double> rotation_deg(std::size_t frame) const;
};

/// `targets` and `rig` as the tracker is told of them: with covariances, whose share is in the prediction,
/// or without. `visibility` holds what each camera sees in each of the poses.
[[nodiscard]] PredictedAccuracy predict_along(std::span<const Target> targets, const StereoRig& rig,
                                              std::span<const RigidMotion> tracker_from_body,
                                              const MotionVisibility& visibility,
                                              std::span<const WorkPoint> points,
                                              const AccuracyOptions& options);

/// The same points and poses with other covariances, by frame; none: not determined.
[[nodiscard]] PredictedAccuracy with_covariances(const PredictedAccuracy& predicted,
                                                 std::span<const RigidMotion> tracker_from_body,
                                                 std::span<const std::optional<Mat6>> covariances);

/// Where and when the predicted error is largest.
struct WorstMoment {
  std::size_t point = 0, frame = 0;
  double error_mm = 0;
};
/// Among points [first, last); none where no frame is determined.
[[nodiscard]] std::optional<WorstMoment> worst_moment(const PredictedAccuracy& predicted, std::size_t first,
                                                      std::size_t last);
/// Among the named points, or all where none is named.
[[nodiscard]] std::optional<WorstMoment> worst_moment(const PredictedAccuracy& predicted);

/// Sigmas of centres for prediction: at the level of centres what the cell's noise states; of images the
/// bound of a disc's centre from the sensor's noise and blur.
enum class CentreLevel { Centres, Images };
[[nodiscard]] AccuracyOptions accuracy_options_of(const Cell& cell, CentreLevel level);

}  // namespace asterism
