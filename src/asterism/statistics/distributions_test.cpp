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

}  // namespace
}  // namespace asterism
