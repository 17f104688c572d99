// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// The pixels around one target, rows padded to a multiple of eight. Grey levels run from 0 to 1.
struct Patch {
  int x = 0, y = 0;  // image coordinates of its first pixel
  int stride = 0, rows = 0;
  std::vector<float> grey;
  std::vector<float> usable;      // 1, or 0 where the pixel must not count
  std::vector<float> unevenness;  // background minus its mean; empty when it is even
  std::vector<std::array<int, 2>>
      spans;  // of each row: from which to before which column pixels count at all
};

/// A disc's image: an ellipse |M (p − centre)| = 1 with M symmetric, blurred by a Gaussian.
///   grey(p) = (background + unevenness(p)) (1 − m) + (background + amplitude) m,  m = Φ(−t)
///   t = d/s + s κ/2,  d = signed distance to the ellipse (first order along the ray from the centre: exact
///   for circles), κ = curvature there. A curved front blurred by a two-dimensional Gaussian recedes by s²
///   κ/2.
struct EdgeModel {
  double x = 0, y = 0;  // centre, px, relative to the patch's first pixel
  double m11 = 0, m12 = 0, m22 = 0;
  double amplitude = 0, background = 0;
  double blur = 0.75;  // s, px; holds the pixel's own extent too

  static constexpr int kParameters = 8;
};

/// Variance of a pixel: outside + linear · m, m the share of the disc in it.
struct EdgeNoise {
  double outside = 1, linear = 0;
};

/// Weighted normal equations of the model about `model`: Σ w j jᵀ (upper triangle by rows), Σ w j r, Σ w r²
/// with j the derivatives of the model in the order of EdgeModel's members and r = measured − model.
struct NormalEquations {
  static constexpr int kUpper = EdgeModel::kParameters * (EdgeModel::kParameters + 1) / 2;
  std::array<float, kUpper> matrix{};
  std::array<float, EdgeModel::kParameters> right{};
  float chi_square = 0;
  float usable = 0;  // pixels
};
[[nodiscard]] NormalEquations normal_equations(const Patch& patch, const EdgeModel& model,
                                               const EdgeNoise& noise);

/// Signed distance of each pixel within the spans to the model's ellipse, px.
[[nodiscard]] std::vector<float> distances(const Patch& patch, const EdgeModel& model);

}  // namespace asterism
