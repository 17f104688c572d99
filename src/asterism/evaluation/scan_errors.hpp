// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "asterism/geometry/surface_tree.hpp"
#include "asterism/scanning/carrying.hpp"

namespace asterism {

/// Errors along the surface's normal against the covariances that come with the points.
struct CloudErrors {
  std::size_t points = 0;       // compared
  std::size_t far_off = 0;      // farther off the surface than was asked: not compared
  double bias_mm = 0;           // mean signed distance, positive outside
  double rms_mm = 0;            // of the distances to the surface
  double predicted_rms_mm = 0;  // √ mean nᵀ C n
  double mean_nees = 0;         // of e² / nᵀ C n: 1 when the covariances are honest, more: too sure
  double in_95_percent = 0;     // share within 1.96 standard deviations
};

/// A fused cloud against the true surface, both in the workpiece's frame. What is systematic is one draw for
/// a whole cloud, so the figures scatter from cloud to cloud: means over several runs tell more.
[[nodiscard]] CloudErrors cloud_errors(std::span<const FusedPoint> cloud, const SurfaceTree& surface,
                                       double within_mm);

/// Errors in space against where the light truly fell.
struct CarriedErrors {
  std::size_t points = 0;
  double rms_mm = 0, predicted_rms_mm = 0;  // √ mean |e|², √ mean tr C
  double mean_nees = 0;                     // of eᵀ C⁻¹ e: 3 when the covariances are honest
};

/// A carried scan of which no point was left out against the truth of its points, in its order. C is that of
/// the scanner and of the pose, systematic parts included.
[[nodiscard]] CarriedErrors carried_errors(const CarriedScan& carried, std::span<const Vec3f> truth);

}  // namespace asterism
