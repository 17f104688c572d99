// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "asterism/accuracy/accuracy_options.hpp"
#include "asterism/evaluation/disturbed_cell.hpp"
#include "asterism/tracking/pose.hpp"
#include "asterism/visibility/visibility.hpp"

namespace asterism {

/// How a pose is made from labelled centres: maximum likelihood of all centres (tracking/pose.hpp); least
/// squares of triangulated points (the paper's Eq. 18); the frame of the first three of them (Section 2.3).
enum class Estimator { MaximumLikelihood, LeastSquares, ThreePoints };
[[nodiscard]] std::string_view text_of(Estimator estimator);

/// Which of the effects that have a mean are in force.
struct MeansInForce {
  bool smear = true, latency = true, thermal = true;
};

/// One body's pose at one moment as a function of standard normal inputs: all that goes wrong between the
/// true pose and the one in use. Labels are known; what a wrong label does is for the whole tracker to show.
///
///   centre = mean over the exposure of the disc's image + detection + smear
///   pose   = estimator(centres, the rig as believed, the targets as believed)
///   error  = (true pose when it is used) − pose
///
/// Each input moves one thing by one sigma. So the first-order budget, the Monte Carlo by JCGM 101 and the
/// disturbance runs are made of one and the same model.
class PoseExperiment {
 public:
  struct Inputs {
    ErrorSource source;
    std::size_t first, count;
  };

  /// `noise` gives the centres' sigmas (sigma_px, bound). The cell's NoiseModel gives the rest.
  PoseExperiment(const Cell& cell, std::size_t mover, double time_s, const std::array<TargetMask, 2>& seen,
                 const AccuracyOptions& noise);

  /// Detection: four numbers a target (left x y, right x y); smear: two a target; map: three a target;
  /// calibration: one a parameter; latency and warmth: one each. Targets that are not seen have theirs too,
  /// so that a number's place does not depend on what is seen.
  [[nodiscard]] const std::array<Inputs, kErrorSources>& inputs() const { return inputs_; }
  [[nodiscard]] const Inputs& inputs(ErrorSource source) const {
    return inputs_[static_cast<std::size_t>(source)];
  }
  [[nodiscard]] std::size_t input_count() const { return count_; }

  /// What takes the pose in use to the truth (ω, δ as in rigid_motion.hpp). `lost` targets are not seen at
  /// all.
  [[nodiscard]] Result<Vec6, PoseFailure> error(std::span<const double> inputs,
                                                Estimator estimator = Estimator::MaximumLikelihood,
                                                TargetMask lost = 0, const MeansInForce& means = {}) const;

  /// The error at a point of the body, along the tracker's axes, mm; to first order in the error.
  [[nodiscard]] Vec3 at_point(const Vec6& error, const Vec3& in_body) const;

  [[nodiscard]] const RigidMotion& truth() const { return truth_; }
  [[nodiscard]] std::span<const Target> targets() const { return targets_; }
  [[nodiscard]] const std::array<TargetMask, 2>& seen() const { return seen_; }

 private:
  struct View {
    int target;
    Side side;
    Vec2 px, sharp_px;  // mean over the exposure; at its middle
    double sigma_px;
    Vec2 smear_px;  // 1σ of what the smear adds, along it
  };
  [[nodiscard]] std::vector<TargetView> views(std::span<const double> inputs, TargetMask lost,
                                              const MeansInForce& means) const;
  void add_view(const Cell& cell, int target, Side side, double time_s, const AccuracyOptions& noise);

  Disturber disturber_;
  NoiseModel model_;
  std::size_t mover_;
  double time_s_;
  Motion motion_;
  RigidMotion truth_;
  std::vector<Target> targets_;
  std::array<TargetMask, 2> seen_;
  std::vector<View> views_;
  std::array<Inputs, kErrorSources> inputs_{};
  std::size_t count_ = 0;
};

}  // namespace asterism
