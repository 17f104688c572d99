// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/calibration/body_learning_bundle.hpp"

namespace asterism {

/// ViewResidual of one view, whitened.
struct ViewResidual {
  Vec2 whitened;
  Eigen::Matrix<double, 2, 3> by_position;
  Mat26 by_pose;
  Mat2 whitener;  // Wᵀ W = covariance⁻¹
};

[[nodiscard]] Result<ViewResidual, LensFailure> residual_of(const StereoRig& rig, const BodyModel& model,
                                                            const BodyView& view);

/// Huber's loss of a whitened residual of this length.
[[nodiscard]] double huber_cost(double norm);

/// Normal equations with the poses eliminated. `with_rig` also gathers the coupling to the rig's
/// parameters.
struct ReducedEquations {
  MatX information;                 // 3N × 3N
  VecX gradient;                    // 3N
  MatX by_rig;                      // 3N × parameters of the rig
  std::vector<Mat6> inverse_poses;  // of the undamped blocks, given the coordinates
  std::vector<Vec6> pose_gradients;
  std::vector<MatX> pose_coupling;  // 6 × 3N
};

/// What the equations are made of; damping is Levenberg–Marquardt's.
struct EquationInput {
  const StereoRig& rig;
  const BodyModel& model;
  const std::vector<BodyView>& views;
  bool robust;
  double damping;
  bool with_rig;
};

/// Sums up the views that are not rejected. False when a view has no image or a pose is not determined.
[[nodiscard]] bool assemble_equations(const EquationInput& in, ReducedEquations& reduced);

}  // namespace asterism
