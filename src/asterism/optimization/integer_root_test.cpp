// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/integer_root.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

TEST(IntegerRoot, IsTheRootToFourteenDigits) {
  RandomStream random(1, 0);
  for (const int n : {1, 2, 3, 16, 21, 101, 501}) {
    const IntegerRoot root(n);
    for (int i = 0; i < 20000; ++i) {
      const double x = std::ldexp(random.uniform(0.5, 1), static_cast<int>(random.below(2000)) - 1000);
      const double expected = static_cast<double>(std::pow(static_cast<long double>(x), 1.0L / n));
      EXPECT_NEAR(root(x) / expected, 1, 6e-15) << x << " " << n;
    }
  }
}

TEST(IntegerRoot, KeepsOne) {
  for (const int n : {1, 2, 21, 31}) EXPECT_NEAR(IntegerRoot(n)(1.0), 1, 6e-15) << n;
}

TEST(IntegerPower, MultipliesSoManyTimes) {
  EXPECT_EQ(integer_power(3, 0), 1);
  EXPECT_EQ(integer_power(3, 5), 243);
  EXPECT_EQ(integer_power(0.5, 21), 0x1p-21);
}

}  // namespace
}  // namespace asterism
