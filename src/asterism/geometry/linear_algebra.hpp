// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/geometry/types.hpp"

// Decompositions live behind this one source file: Eigen's cost many seconds of build time a file.

namespace asterism {

using MatX = Eigen::MatrixXd;
using VecX = Eigen::VectorXd;

/// Eigenvalues ascending, eigenvectors as columns.
struct SymmetricEigen3 {
  Vec3 values;
  Mat3 vectors;
};
[[nodiscard]] SymmetricEigen3 symmetric_eigen(const Mat3& symmetric);

struct SymmetricEigen2 {
  Vec2 values;
  Mat2 vectors;
};
[[nodiscard]] SymmetricEigen2 symmetric_eigen(const Mat2& symmetric);

/// Eigenvalues of a symmetric matrix of any size, ascending.
[[nodiscard]] VecX symmetric_eigenvalues(const MatX& symmetric);

/// The symmetric root of a positive semidefinite matrix: covariance = root · root. What rounding made
/// negative counts as zero.
[[nodiscard]] MatX symmetric_root(const MatX& symmetric);

struct Svd3 {
  Mat3 u;
  Vec3 singular_values;  // descending
  Mat3 v;
};
[[nodiscard]] Svd3 svd(const Mat3& matrix);

/// Solves A x = b for symmetric positive definite A (Cholesky). Empty when A is not positive definite.
[[nodiscard]] std::optional<Vec6> solve_positive(const Mat6& a, const Vec6& b);
[[nodiscard]] std::optional<VecX> solve_positive(const MatX& a, const VecX& b);

/// Inverse of a symmetric positive definite matrix. Empty when it is not.
[[nodiscard]] std::optional<Mat6> inverse_positive(const Mat6& a);
[[nodiscard]] std::optional<MatX> inverse_positive(const MatX& a);

/// ln det of a symmetric positive definite matrix. Empty when it is not.
[[nodiscard]] std::optional<double> log_determinant_positive(const Mat6& a);

/// Least squares A x ≈ b by QR with column pivoting.
[[nodiscard]] VecX least_squares(const MatX& a, const VecX& b);

}  // namespace asterism
