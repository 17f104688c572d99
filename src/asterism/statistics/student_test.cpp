// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/student.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

const std::vector<double> kBefore = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const std::vector<double> kAfter = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

TEST(PairedTTest, SplitsTheTwoSidedProbabilityBetweenBothSides) {
  const double two = paired_t_test(kBefore, kAfter).p;
  EXPECT_NEAR(paired_t_test(kBefore, kAfter, Alternative::Less).p, two / 2, 1e-15);
  EXPECT_NEAR(paired_t_test(kBefore, kAfter, Alternative::Greater).p, 1 - two / 2, 1e-12);
  EXPECT_NEAR(paired_t_test(kAfter, kBefore).p, two, 1e-15);
}

TEST(PairedTTest, TellsTheEffectInDeviationsOfThePairs) {
  const TTest test = paired_t_test(kBefore, kAfter);
  EXPECT_NEAR(test.effect_size, test.t / std::sqrt(10.0), 1e-14);
  EXPECT_NEAR(test.difference, -1.58, 1e-12);
}

TEST(PairedTTest, RefusesPairsThatDifferByAConstantOnly) {
  EXPECT_THROW(static_cast<void>(paired_t_test(std::vector<double>{1, 2, 3}, std::vector<double>{2, 3, 4})),
               ContractViolation);
  EXPECT_THROW(static_cast<void>(paired_t_test(std::vector<double>{1, 2}, std::vector<double>{1})),
               ContractViolation);
}

TEST(PooledTTest, GivesTheTestOfR) {
  // R: t.test(extra ~ group, data = sleep, var.equal = TRUE): t = −1.8608, df = 18, p = 0.07919.
  const TTest test = pooled_t_test(summarize(kBefore), summarize(kAfter));
  EXPECT_NEAR(test.t, -1.8608, 5e-5);
  EXPECT_EQ(test.degrees, 18);
  EXPECT_NEAR(test.p, 0.07919, 5e-6);
}

TEST(WelchTTest, RaisesAFalseAlarmAsOftenAsItSaysWhenTheSpreadsDiffer) {
  int alarms = 0;
  constexpr int kRuns = 4000;
  for (int run = 0; run < kRuns; ++run) {
    RandomStream random(11, static_cast<std::uint64_t>(run));
    std::vector<double> narrow(8), wide(24);
    for (double& value : narrow) value = random.normal();
    for (double& value : wide) value = 4 * random.normal();
    alarms += welch_t_test(summarize(narrow), summarize(wide)).p < 0.05;
  }
  EXPECT_NEAR(alarms / static_cast<double>(kRuns), 0.05, 4 * std::sqrt(0.0475 / kRuns));
}

TEST(HolmAdjusted, GivesTheValuesOfR) {
  // R: p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm") = 0.03 0.06 0.06 0.02.
  const std::vector<double> adjusted = holm_adjusted(std::vector<double>{0.01, 0.04, 0.03, 0.005});
  const double expected[] = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-15);
  EXPECT_EQ(holm_adjusted(std::vector<double>{0.7, 0.9})[1], 1);
}

TEST(PowerOfTTest, GivesTheValuesOfR) {
  // R's help page of power.t.test: n = 20, delta = 1, sd = 1 → 0.8689528; with strict = TRUE 0.8689530.
  const TTestPlan plan{.effect_size = 1, .design = TTestDesign::TwoSamples};
  EXPECT_NEAR(power_of_t_test(plan, 20), 0.8689530, 5e-8);
}

TEST(PowerOfTTest, IsTheShareOfDrawnTestsThatFindTheDifference) {
  const TTestPlan plan{.effect_size = 0.5, .alpha = 0.05, .alternative = Alternative::Greater};
  int found = 0;
  constexpr int kRuns = 4000;
  for (int run = 0; run < kRuns; ++run) {
    RandomStream random(2, static_cast<std::uint64_t>(run));
    std::vector<double> a(15), b(15, 0.0);
    for (double& value : a) value = 0.5 + random.normal();
    found += paired_t_test(a, b, Alternative::Greater).p < 0.05;
  }
  const double power = power_of_t_test(plan, 15);
  EXPECT_NEAR(found / static_cast<double>(kRuns), power, 4 * std::sqrt(power * (1 - power) / kRuns));
}

TEST(SampleSizeFor, GivesTheSizesOfR) {
  // R: power.t.test(power = .90, delta = 1) n = 22.02; alternative = "one.sided" n = 17.85.
  TTestPlan plan{.effect_size = 1, .design = TTestDesign::TwoSamples};
  EXPECT_EQ(sample_size_for(plan, 0.9), 23U);
  plan.alternative = Alternative::Greater;
  EXPECT_EQ(sample_size_for(plan, 0.9), 18U);
}

TEST(SampleSizeFor, FollowsTheNormalLawForTinyDifferences) {
  // (z₀.₉₇₅ + z₀.₈)² / d² pairs.
  EXPECT_NEAR(static_cast<double>(sample_size_for({.effect_size = 0.005})), 7.8488797 / (0.005 * 0.005), 5);
  EXPECT_THROW(static_cast<void>(sample_size_for({.effect_size = 0})), ContractViolation);
}

}  // namespace
}  // namespace asterism
