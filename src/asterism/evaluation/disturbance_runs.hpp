// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asterism/evaluation/pose_experiment.hpp"

namespace asterism {

/// A layout of targets to be disturbed: at rest, as the paper does (Tables 13 and 14), and at moments of the
/// motion, as it will be used.
struct LayoutTrial {
  std::string name;
  PoseExperiment at_rest;
  std::vector<PoseExperiment> moments;
  /// Where errors are told, as VerifiedBody has them: the layout's own centroid, the origin, named points.
  std::vector<WorkPoint> points;
};

/// What is told of a run.
enum class RunQuantity { RotationDeg, CentroidMm, OriginMm, WorstPointMm };
constexpr std::size_t kRunQuantities = 4;
[[nodiscard]] std::string_view text_of(RunQuantity quantity);

/// The worst point is the one of the named points with the largest error in this run.
using RunErrors = std::array<double, kRunQuantities>;

struct LayoutRuns {
  std::string name;
  std::vector<std::optional<RunErrors>> at_rest;  // by run; none: no pose
  std::vector<std::optional<RunErrors>> moving;   // RMS over the moments with a pose
  std::size_t poses = 0, without_pose = 0;        // of the moments of all runs
};

struct DisturbanceOptions {
  std::size_t runs = 5000;
  std::uint64_t seed = 1;
  double target_loss = 0;  // share of targets missed at a moment, each by itself
  Estimator estimator = Estimator::MaximumLikelihood;
};

/// The draws of a run are keyed by (seed, run, moment) and by the place of a target in its list: the same run
/// of two layouts has the same rig error and the same noise wherever both have a target.
[[nodiscard]] LayoutRuns disturb(const LayoutTrial& trial, const DisturbanceOptions& options);

/// The standard normal inputs of one run at one moment.
[[nodiscard]] std::vector<double> inputs_of_run(const PoseExperiment& experiment, std::uint64_t seed,
                                                std::uint64_t run, std::uint64_t moment);

}  // namespace asterism
