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
  std::vector<float> usable;  // 1, or 0 where the pixel must not count
  std::vector<std::array<int, 2>>
      spans;  // of each row: from which to before which column pixels count at all
};

/// A disc's image: an ellipse |M (p − centre)| = 1 with M symmetric, blurred by a Gaussian.
///   grey(p) = background + amplitude · m,  m = Φ(−t),  t = d/s + s κ/2
/// d = signed distance to the ellipse (first order along the ray from the centre: exact for circles), κ = its
/// curvature there: a curved front blurred by a two-dimensional Gaussian recedes by s² κ/2.
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

/// How the blurred edge differs from a Gaussian's: Edgeworth terms of the edge's profile, all zero for a
/// Gaussian.
///   m = Φ(−t) + φ(t) [(fourth + fourth_diagonal 4c²s²) He₃(t) + (sixth + sixth_diagonal 4c²s²) He₅(t)]
/// (c, s) is the edge's normal: pixels are square, so an edge along their sides differs from one across.
/// Lens and sensor make it, so all targets of an image share it.
struct EdgeProfile {
  double fourth = 0, fourth_diagonal = 0, sixth = 0, sixth_diagonal = 0;

  bool operator==(const EdgeProfile&) const = default;
  static constexpr int kParameters = 4;
};

/// Weighted normal equations of the model: Σ w j jᵀ (upper triangle by rows), Σ w j r, Σ w r² with j the
/// derivatives of the model in the order of EdgeModel's members and r = measured − model.
template <int kN>
struct NormalSums {
  static constexpr int kUpper = kN * (kN + 1) / 2;
  std::array<float, kUpper> matrix{};
  std::array<float, kN> right{};
  float chi_square = 0;
  float usable = 0;  // pixels
};
using NormalEquations = NormalSums<EdgeModel::kParameters>;
[[nodiscard]] NormalEquations normal_equations(const Patch& patch, const EdgeModel& model,
                                               const EdgeProfile& profile, const EdgeNoise& noise);

/// The same with the profile's four parameters behind the model's eight.
using ProfileEquations = NormalSums<EdgeModel::kParameters + EdgeProfile::kParameters>;
[[nodiscard]] ProfileEquations profile_equations(const Patch& patch, const EdgeModel& model,
                                                 const EdgeProfile& profile, const EdgeNoise& noise);

/// Signed distance of each pixel within the spans to the model's ellipse, px.
[[nodiscard]] std::vector<float> distances(const Patch& patch, const EdgeModel& model);

}  // namespace asterism
