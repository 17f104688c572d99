// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/linear_algebra.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

Mat6 positive_matrix() {
  Mat6 a;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) a(i, j) = 1.0 / (1 + std::abs(i - j)) + (i == j ? 1.0 : 0.0);
  }
  return a;
}

TEST(SolvePositive, SolvesAndInverts) {
  const Mat6 a = positive_matrix();
  const Vec6 x = Vec6::LinSpaced(-2, 3);
  const auto solved = solve_positive(a, Vec6(a * x));
  ASSERT_TRUE(solved);
  EXPECT_LT((*solved - x).norm(), 1e-13);
  EXPECT_LT((a * *inverse_positive(a) - Mat6::Identity()).norm(), 1e-13);
}

TEST(SolvePositive, RefusesSingularIndefiniteAndNotANumber) {
  Mat6 singular = positive_matrix();
  singular.row(5) = singular.row(4);
  singular.col(5) = singular.col(4);
  EXPECT_FALSE(solve_positive(singular, Vec6(Vec6::Ones())));
  Mat6 indefinite = positive_matrix();
  indefinite(3, 3) = -1;
  EXPECT_FALSE(inverse_positive(indefinite));
  Mat6 broken = positive_matrix();
  broken(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(inverse_positive(broken));
}

TEST(LogDeterminantPositive, AddsUpTheEigenvalues) {
  const Mat6 a = positive_matrix();
  EXPECT_NEAR(log_determinant_positive(a).value(), symmetric_eigenvalues(a).array().log().sum(), 1e-12);
  EXPECT_FALSE(log_determinant_positive(Mat6(-a)));
}

TEST(SymmetricEigen, RebuildsItsMatrix) {
  Mat3 a;
  a << 4, 1, 0.5, 1, 3, -0.2, 0.5, -0.2, 2;
  const auto eigen = symmetric_eigen(a);
  EXPECT_LT((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - a).norm(), 1e-13);
  EXPECT_LE(eigen.values(0), eigen.values(1));
}

TEST(LeastSquares, FitsALine) {
  MatX a(4, 2);
  a << 1, 0, 1, 1, 1, 2, 1, 3;
  const VecX line = least_squares(a, (VecX(4) << 1, 3, 5, 7).finished());
  EXPECT_NEAR(line(0), 1, 1e-12);
  EXPECT_NEAR(line(1), 2, 1e-12);
}

}  // namespace
}  // namespace asterism
