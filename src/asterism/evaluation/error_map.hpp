// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "asterism/evaluation/predicted_accuracy.hpp"

namespace asterism {

/// The mean square error E|e|² of points fixed in a body as a function of the point, for one pose:
///
///   c + l·p + pᵀ Q p,   c = tr Σ_δδ,   Q = tr(A) I − A,   A = Rᵀ Σ_ωω R,   B = Rᵀ Σ_ωδ R,
///   l = 2 (B_zy − B_yz, B_xz − B_zx, B_yx − B_xy)   (e = δ + ω × R p)
///
/// The same that covariance_of_point gives, at a tenth of its cost.
struct SquareErrorForm {
  double constant = 0;
  Vec3 linear = Vec3::Zero();
  Mat3 square = Mat3::Zero();

  [[nodiscard]] double at(const Vec3& in_body) const {
    return constant + linear.dot(in_body) + in_body.dot(square * in_body);
  }
};
[[nodiscard]] SquareErrorForm square_error_form(const RigidMotion& tracker_from_body, const Mat6& covariance);

/// Worst predicted error over a motion at each vertex of a surface.
struct ErrorMap {
  std::vector<double> error_mm;  // by vertex
  std::size_t worst = 0;         // that vertex
};

/// `vertices` in the body's frame. None when the pose is determined in no frame, or there is no vertex.
[[nodiscard]] std::optional<ErrorMap> error_map(std::span<const Vec3> vertices,
                                                const PredictedAccuracy& predicted,
                                                std::span<const RigidMotion> tracker_from_body);

}  // namespace asterism
