// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "asterism/core/result.hpp"
#include "asterism/geometry/types.hpp"

namespace asterism {

/// One camera's imaging: pinhole with skew (paper Eqs. 5–9, its γ) and OpenCV's lens distortion in
/// OpenCV's order k1 k2 p1 p2 [k3 [k4 k5 k6 [s1 s2 s3 s4 [τx τy]]]].
struct Lens {
  double fx = 1, fy = 1;  // px
  double skew = 0;        // px; u = fx x″ + skew y″ + cx
  double cx = 0, cy = 0;  // px; (0, 0) is the centre of the top-left pixel
  std::array<double, 14> distortion{};
  int coefficients = 0;  // how many of them are in use: 0, 4, 5, 8, 12 or 14
  int width_px = 0, height_px = 0;
};

enum class LensFailure { BehindCamera, NoConvergence };

struct Projection {
  Vec2 px;
  Mat23 by_point;  // ∂px / ∂point
};

struct DistortionResult {
  Vec2 xy;     // distorted, normalised
  Mat2 by_xy;  // ∂ / ∂ undistorted
};

/// Undistorted to distorted normalised coordinates.
[[nodiscard]] DistortionResult distort(const Lens& lens, const Vec2& xy);

/// The homography of the tilted sensor, applied last; the identity with fewer than 14 coefficients.
[[nodiscard]] Mat3 sensor_tilt(const Lens& lens);

/// Normalised (distorted) coordinates to pixels and the constant Jacobian of that map.
[[nodiscard]] Vec2 pixel_from_normalised(const Lens& lens, const Vec2& xy);
[[nodiscard]] Mat2 pixel_by_normalised(const Lens& lens);

/// The image of a point in the camera's frame (mm).
[[nodiscard]] Result<Projection, LensFailure> project(const Lens& lens, const Vec3& in_camera);

struct SightLine {
  Vec2 xy;     // undistorted: the ray is (x, y, 1)
  Mat2 by_px;  // ∂xy / ∂px
};

/// Pixel to sight line: Newton on the distortion, to 1e-13. NoConvergence where the polynomial folds back.
[[nodiscard]] Result<SightLine, LensFailure> sight_line(const Lens& lens, const Vec2& px);

/// ∂px / ∂(fx, fy, skew, cx, cy, distortion…): 2 × (5 + coefficients), for calibration.
using ParameterJacobian = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 19>;
[[nodiscard]] ParameterJacobian pixel_by_parameters(const Lens& lens, const Vec2& undistorted_xy);

}  // namespace asterism
