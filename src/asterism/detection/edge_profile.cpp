// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/edge_profile.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

constexpr Eigen::Index kOwn = EdgeModel::kParameters, kShared = EdgeProfile::kParameters;

/// The view's information on the shared parameters once its own are free, and the right side.
struct Reduced {
  MatX matrix;
  VecX right;
};

std::optional<Reduced> reduced(const ProfileView& view, const EdgeProfile& profile) {
  const ProfileEquations sums = profile_equations(*view.patch, view.model, profile, view.noise);
  MatX matrix(kOwn + kShared, kOwn + kShared);
  VecX right(kOwn + kShared);
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = i; j < matrix.cols(); ++j) matrix(i, j) = matrix(j, i) = sums.matrix[k++];
    right[i] = sums.right[static_cast<std::size_t>(i)];
  }
  const Eigen::Index blur = kOwn - 1;
  const double precision = view.blur.deviation > 0 ? std::pow(view.blur.deviation, -2) : 1e12;
  matrix(blur, blur) += precision;
  right[blur] += precision * (view.blur.mean - view.model.blur);
  const auto inverse = inverse_positive(MatX(matrix.topLeftCorner(kOwn, kOwn)));
  if (!inverse) return std::nullopt;
  const MatX cross = matrix.topRightCorner(kOwn, kShared);
  const MatX eliminate = cross.transpose() * *inverse;
  return Reduced{matrix.bottomRightCorner(kShared, kShared) - eliminate * cross,
                 right.tail(kShared) - eliminate * right.head(kOwn)};
}

}  // namespace

EdgeProfile improved_profile(const EdgeProfile& profile, std::span<const ProfileView> views) {
  // Edgeworth terms far larger than these are no blur: they keep a wild estimate harmless.
  constexpr double kMost = 0.06;
  // A priori the terms are about this large (fourth cumulant 0.5, sixth about 2 of a unit variance).
  const Eigen::Vector4d expected(0.02, 0.02, 0.003, 0.003);
  MatX matrix = MatX::Zero(kShared, kShared);
  matrix.diagonal() = expected.cwiseAbs2().cwiseInverse();
  const Eigen::Vector4d now(profile.fourth, profile.fourth_diagonal, profile.sixth, profile.sixth_diagonal);
  VecX right = -matrix.diagonal().cwiseProduct(now);
  for (const ProfileView& view : views) {
    const auto part = reduced(view, profile);
    if (!part) continue;
    matrix += part->matrix;
    right += part->right;
  }
  const auto step = solve_positive(matrix, right);
  if (!step) return profile;
  const auto bounded = [&](Eigen::Index i, double most) {
    return std::clamp(now[i] + (*step)[i], -most, most);
  };
  return {bounded(0, kMost), bounded(1, kMost), bounded(2, 0.1 * kMost), bounded(3, 0.1 * kMost)};
}

}  // namespace asterism
