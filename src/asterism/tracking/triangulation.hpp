// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/camera/two_view.hpp"
#include "asterism/core/options.hpp"
#include "asterism/measurement/centre.hpp"
#include "asterism/measurement/point.hpp"

namespace asterism {

struct TriangulationOptions {
  double gate_sigmas = 4.0;   // how far from meeting two sight lines may be
  double rig_error_px = 0.1;  // epipolar error of the calibration (one sigma), beside the centres' own
  double min_depth_mm = 1.0;  // along the left camera's axis
  double max_depth_mm = 1e5;
  double max_size_ratio = 0.0;  // of the disc's sizes told by the two images; 0 = not asked
  int max_centres = 2000;       // in one image; beyond, the brightest are taken
  int max_points = 5000;        // beyond, those that meet best
};
void describe(TriangulationOptions& options, OptionVisitor& visit);

/// All pairs of a left and a right centre whose sight lines meet within the gate
///
///   |e| ≤ gate_sigmas · √(σ_e² + rig_error_px²)
///
/// with e the epipolar error and σ_e what the centres' covariances let it be. A centre may take part in
/// several points; identification tells which is real. The two lines are compared by the angle of their
/// planes through the baseline, so that sorting finds the partners without trying each pair. Ordered by left,
/// then right index.
///
/// Where e is larger than the centres explain (an imperfect rig), the point's covariance is widened to match.
[[nodiscard]] std::vector<Point> triangulate(std::span<const Centre> left, std::span<const Centre> right,
                                             const StereoRig& rig, const TriangulationOptions& options);

}  // namespace asterism
