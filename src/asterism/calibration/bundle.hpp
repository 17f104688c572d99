// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "asterism/calibration/board.hpp"
#include "asterism/calibration/board_view.hpp"
#include "asterism/camera/stereo_rig.hpp"

namespace asterism {

/// One placing of the board, seen by one camera or both.
struct BundleView {
  std::optional<BoardView> left, right;
  RigidMotion tracker_from_board;

  [[nodiscard]] const std::optional<BoardView>& seen_by(Side side) const {
    return side == Side::Left ? left : right;
  }
};

/// Two points at a known distance, seen by both cameras: ends of a scale bar.
struct ScaleBarView {
  double length_mm = 0, sigma_mm = 0;
  Vec2 px[2][2];          // [side][end]
  Mat2 covariance[2][2];  // px²
};

/// All that is adjusted together. The cameras are called left and right also where only one is calibrated.
struct Bundle {
  Board board;
  StereoRig rig;  // the start, then the result; `coefficients` of each lens are estimated
  std::vector<BundleView> views;
  std::vector<ScaleBarView> bars;  // with bars the board's pitch is estimated too: they tell the length
  double model_sigma_px = 0;       // what board and lens model leave over, added to each point's covariance
  bool hold_rig = false;           // only the board's poses
  bool estimate_skew = false;
  bool estimate_diameter = false;  // of circle grids
};

struct BundleSettings {
  double robust_sigmas = 3.0;  // Huber's threshold on a point's whitened residual
  int iterations = 50;
};

/// Residual of one point in one image: measured − modelled.
struct BundleResidual {
  int view;
  Side side;
  int point;  // index into the BoardView's points
  Vec2 px;
  Mat2 covariance;  // px², of the measurement without model_sigma
};

/// Least squares over the lenses, the motion between the cameras and each placing (Ceres, analytic
/// Jacobians, Huber's loss), in place. False when it did not converge to a finite rig.
[[nodiscard]] bool adjust(Bundle& bundle, const BundleSettings& settings = {});

[[nodiscard]] std::vector<BundleResidual> residuals_of(const Bundle& bundle);

/// Covariance of the rig's parameters in the order of StereoRig::covariance_order as rig_parameter_names
/// gives it, everything else marginalised; held parameters have zero rows. Empty when the views do not
/// determine the rig. For unit variance factor.
[[nodiscard]] std::optional<MatX> rig_covariance(const Bundle& bundle);

/// How many numbers the adjustment estimates.
[[nodiscard]] int parameter_count(const Bundle& bundle);

}  // namespace asterism
