// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/monte_carlo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// JCGM 101, 9.2: Y = X₁ + X₂ + X₃ + X₄, each of standard uncertainty 1.
double sum_of_normals(RandomStream& random) {
  return random.normal() + random.normal() + random.normal() + random.normal();
}
double sum_of_rectangles(RandomStream& random) {
  const double half = std::sqrt(3.0);
  double sum = 0;
  for (int i = 0; i < 4; ++i) sum += random.uniform(-half, half);
  return sum;
}
const Model kSum = [](std::span<const double> x) { return x[0] + x[1] + x[2] + x[3]; };

TEST(MonteCarlo, GivesTheStandardsNormalSum) {  // table 2
  const MonteCarlo drawn = monte_carlo(sum_of_normals, {.significant_digits = 2});
  EXPECT_TRUE(drawn.stable);
  EXPECT_EQ(drawn.tolerance, 0.05);
  EXPECT_NEAR(drawn.estimate, 0, drawn.tolerance);
  EXPECT_NEAR(drawn.uncertainty, 2, drawn.tolerance);
  EXPECT_NEAR(drawn.interval.low, -3.92, drawn.tolerance);
  EXPECT_NEAR(drawn.interval.high, 3.92, drawn.tolerance);
}

TEST(MonteCarlo, GivesTheStandardsRectangularSum) {  // table 3: [−3.88, 3.88]
  const MonteCarlo drawn = monte_carlo(sum_of_rectangles, {.significant_digits = 2});
  EXPECT_TRUE(drawn.stable);
  EXPECT_NEAR(drawn.interval.low, -3.88, drawn.tolerance);
  EXPECT_NEAR(drawn.interval.high, 3.88, drawn.tolerance);
}

TEST(MonteCarlo, FindsTheShortestIntervalOfASkewQuantity) {
  // Exponential: 95 % symmetric [−ln 0.975, −ln 0.025], shortest [0, −ln 0.05].
  const MonteCarlo drawn = monte_carlo([](RandomStream& random) { return -std::log1p(-random.uniform()); });
  EXPECT_NEAR(drawn.interval.low, 0.0253, drawn.tolerance);
  EXPECT_NEAR(drawn.interval.high, 3.6889, drawn.tolerance);
  EXPECT_NEAR(drawn.shortest.low, 0, drawn.tolerance);
  EXPECT_NEAR(drawn.shortest.high, 2.9957, drawn.tolerance);
}

TEST(MonteCarlo, GivesTheSameBitsForAnyThreadCount) {
  set_thread_count(1);
  const MonteCarlo one = monte_carlo(sum_of_normals, {.significant_digits = 1});
  set_thread_count(0);
  const MonteCarlo many = monte_carlo(sum_of_normals, {.significant_digits = 1});
  EXPECT_EQ(one.estimate, many.estimate);
  EXPECT_EQ(one.interval.high, many.interval.high);
  EXPECT_EQ(one.trials, many.trials);
}

TEST(MonteCarlo, SaysWhenItGaveUp) {
  const MonteCarlo drawn =
      monte_carlo([](RandomStream& random) { return std::tan(1.57079 * random.uniform(-1, 1)); },
                  {.most_blocks = 3});  // all but Cauchy's: no standard deviation to settle on
  EXPECT_FALSE(drawn.stable);
  EXPECT_EQ(drawn.trials, 30000U);
}

TEST(MonteCarlo, RefusesATrialWithoutAValue) {
  EXPECT_THROW(static_cast<void>(monte_carlo([](RandomStream&) { return std::nan(""); })), ContractViolation);
}

TEST(NumericalTolerance, IsHalfAUnitOfTheLastDigit) {  // JCGM 101, 7.9.2, examples 1 and 2
  EXPECT_DOUBLE_EQ(numerical_tolerance(0.00035, 2), 0.000005);
  EXPECT_DOUBLE_EQ(numerical_tolerance(2, 1), 0.5);
  EXPECT_DOUBLE_EQ(numerical_tolerance(0.0996, 2), 0.005);
  EXPECT_EQ(numerical_tolerance(0, 2), 0);
}

TEST(FirstOrder, PropagatesACovarianceThroughAModel) {
  MatX covariance(2, 2);
  covariance << 0.04, 0.01, 0.01, 0.09;
  const FirstOrder product = first_order([](std::span<const double> x) { return x[0] * x[1]; },
                                         std::vector<double>{3, 5}, covariance);
  EXPECT_DOUBLE_EQ(product.estimate, 15);
  EXPECT_NEAR(product.uncertainty, std::sqrt(25 * 0.04 + 9 * 0.09 + 2 * 15 * 0.01), 1e-9);
}

TEST(CheckFirstOrder, AcceptsTheSumOfNormalsAndRefusesWhatBends) {
  const std::vector<double> zero(4, 0.0);
  const FirstOrder straight = first_order(kSum, zero, MatX::Identity(4, 4));
  const MonteCarlo drawn = monte_carlo(sum_of_normals, {.significant_digits = 2});
  EXPECT_TRUE(check_first_order(straight, drawn).valid);
  // JCGM 101, 9.3: near its minimum a quantity's first-order uncertainty vanishes, and the check says no.
  const FirstOrder flat = first_order([](std::span<const double> x) { return 10 + x[0] * x[0]; },
                                      std::vector<double>{0.1}, MatX::Identity(1, 1));
  const MonteCarlo bent = monte_carlo([](RandomStream& random) {
    const double x = 0.1 + random.normal();
    return 10 + x * x;
  });
  const FirstOrderCheck check = check_first_order(flat, bent);
  EXPECT_FALSE(check.valid);
  EXPECT_GT(check.high_gap, 1);
}

}  // namespace
}  // namespace asterism
