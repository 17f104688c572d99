// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/linear_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <limits>

namespace asterism {
namespace {

// A Cholesky factor whose diagonal shrinks below this share of its start has no digits left.
constexpr double kSingular = 64 * std::numeric_limits<double>::epsilon();

template <class Matrix>
std::optional<Eigen::LLT<Matrix>> cholesky(const Matrix& a) {
  if (!a.allFinite()) return std::nullopt;
  Eigen::LLT<Matrix> factor(a);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const auto diagonal = factor.matrixLLT().diagonal();
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    if (!(diagonal(i) * diagonal(i) > kSingular * a(i, i))) return std::nullopt;
  }
  return factor;
}

}  // namespace

SymmetricEigen3 symmetric_eigen(const Mat3& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen2 symmetric_eigen(const Mat2& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Mat2> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VecX symmetric_eigenvalues(const MatX& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatX>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

MatX symmetric_root(const MatX& symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatX> solver(symmetric);
  const VecX roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return solver.eigenvectors() * roots.asDiagonal() * solver.eigenvectors().transpose();
}

Svd3 svd(const Mat3& matrix) {
  const Eigen::JacobiSVD<Mat3> solver(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {solver.matrixU(), solver.singularValues(), solver.matrixV()};
}

std::optional<Vec6> solve_positive(const Mat6& a, const Vec6& b) {
  const auto factor = cholesky(a);
  if (!factor) return std::nullopt;
  return Vec6(factor->solve(b));
}

std::optional<VecX> solve_positive(const MatX& a, const VecX& b) {
  const auto factor = cholesky(a);
  if (!factor) return std::nullopt;
  return VecX(factor->solve(b));
}

std::optional<Mat6> inverse_positive(const Mat6& a) {
  const auto factor = cholesky(a);
  if (!factor) return std::nullopt;
  return Mat6(factor->solve(Mat6::Identity()));
}

std::optional<MatX> inverse_positive(const MatX& a) {
  const auto factor = cholesky(a);
  if (!factor) return std::nullopt;
  return MatX(factor->solve(MatX::Identity(a.rows(), a.cols())));
}

std::optional<double> log_determinant_positive(const Mat6& a) {
  const auto factor = cholesky(a);
  if (!factor) return std::nullopt;
  return 2 * factor->matrixLLT().diagonal().array().log().sum();
}

VecX least_squares(const MatX& a, const VecX& b) { return a.colPivHouseholderQr().solve(b); }

}  // namespace asterism
