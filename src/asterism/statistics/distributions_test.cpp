// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/distributions.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

// Values of the NIST/SEMATECH e-Handbook, table 1.3.6.7.4, and of the normal table 1.3.6.7.1.
TEST(ChiSquareQuantile, GivesTheTabledValues) {
  EXPECT_NEAR(chi_square_quantile(0.95, 2), 5.991, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.99, 6), 16.812, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.95, 100), 124.342, 5e-4);
}

TEST(ChiSquareTail, UndoesTheQuantile) {
  EXPECT_NEAR(chi_square_tail(chi_square_quantile(0.999, 5), 5), 1e-3, 1e-12);
  EXPECT_EQ(chi_square_tail(0, 3), 1.0);
}

TEST(FisherTail, GivesTheTabledValues) {
  EXPECT_NEAR(fisher_tail(2.866081, 4, 20), 0.05, 1e-6);  // tables of F at 5 %
  EXPECT_NEAR(fisher_tail(19.2468, 4, 2), 0.05, 1e-5);
  EXPECT_EQ(fisher_tail(0, 4, 2), 1.0);
}

TEST(NormalQuantile, GivesTheTabledValues) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959964, 1e-6);
  EXPECT_NEAR(normal_quantile(0.5), 0, 1e-12);
}

TEST(NormalProbability, UndoesTheQuantile) {
  EXPECT_NEAR(normal_probability(normal_quantile(0.031)), 0.031, 1e-15);
}

// NIST/SEMATECH e-Handbook, table 1.3.6.7.2.
TEST(StudentQuantile, GivesTheTabledValues) {
  EXPECT_NEAR(student_quantile(0.975, 10), 2.228, 5e-4);
  EXPECT_NEAR(student_quantile(0.975, 49), 2.010, 5e-4);
  EXPECT_NEAR(student_tail(student_quantile(0.975, 49), 49), 0.025, 1e-14);
  EXPECT_NEAR(student_tail(-1, 1), 0.75, 1e-14);  // Cauchy
}

TEST(NoncentralStudentTail, IsStudentsWithoutADifferenceAndGrowsWithIt) {
  EXPECT_NEAR(noncentral_student_tail(1.3, 7, 0), student_tail(1.3, 7), 1e-13);
  EXPECT_NEAR(noncentral_student_tail(0, 12, 1.5), normal_probability(1.5), 1e-13);  // sign of a normal
}

}  // namespace
}  // namespace asterism
