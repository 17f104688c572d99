// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asterism/geometry/rigid_motion.hpp"
#include "asterism/measurement/point.hpp"

namespace asterism {

struct PointPair {
  int a, b;
  bool operator==(const PointPair&) const = default;
};

/// Points of `a` that a proper rigid motion takes onto points of `b` within what their covariances allow.
struct Congruence {
  RigidMotion b_from_a;
  std::vector<PointPair> pairs;    // by a
  Mat6 covariance = Mat6::Zero();  // of b_from_a
  double chi_square = 0;           // of the pairs' distances after the motion, 3 a pair
};

/// The largest congruent subsets of two point sets, none part of another, largest first and among equals
/// the better fit first. Triangles with equal sides (within covariances and `deformation_mm`) give motions,
/// each grows by the points it takes onto each other. Mirror images drop out, since the rotation is proper.
/// No two pairs share a centre of a camera: at most one point made with it can be real.
[[nodiscard]] std::vector<Congruence> congruent_subsets(std::span<const Point> a, std::span<const Point> b,
                                                        double deformation_mm, std::size_t least_size);

/// The motion that fits the pairs best under their covariances (Gauss–Newton from the plain fit).
/// Empty when the points lie on a line.
[[nodiscard]] std::optional<Congruence> fit_pairs(std::span<const Point> a, std::span<const Point> b,
                                                  std::vector<PointPair> pairs, double deformation_mm);

/// Squared distance of b from where the motion takes a, in units of their joint covariance; the motion's
/// own is part of it.
[[nodiscard]] double mahalanobis_square(const RigidMotion& b_from_a, const Mat6& motion_covariance,
                                        const Point& a, const Point& b, double deformation_mm);

/// At most one of two points made with the same centre of a camera can be real.
[[nodiscard]] bool share_a_centre(const Point& p, const Point& q);

/// χ² of three numbers that chance exceeds once in 2·10⁶: what lies beyond is another point.
inline constexpr double kPointGate = 30.0;

}  // namespace asterism
