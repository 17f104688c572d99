// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

TEST(Summarize, GivesMeanDeviationAndEnds) {
  const std::vector<double> values = {2, 4, 4, 4, 5, 5, 7, 9};
  const Summary summary = summarize(values);
  EXPECT_EQ(summary.count, 8U);
  EXPECT_EQ(summary.mean, 5);
  EXPECT_DOUBLE_EQ(summary.deviation, std::sqrt(32.0 / 7));
  EXPECT_EQ(summary.lowest, 2);
  EXPECT_EQ(summary.highest, 9);
  EXPECT_DOUBLE_EQ(summary.standard_error(), std::sqrt(32.0 / 7 / 8));
}

TEST(Summarize, KeepsTheDeviationWhenAllIsMovedFarAway) {
  RandomStream random(1, 0);
  std::vector<double> near, far;
  for (int i = 0; i < 1000; ++i) {
    near.push_back(std::round(random.normal() * 64) / 64);  // exact in binary, also beside 2³⁰
    far.push_back(near.back() + 0x1p30);
  }
  EXPECT_DOUBLE_EQ(summarize(far).deviation, summarize(near).deviation);
  EXPECT_NEAR(summarize(far).mean - 0x1p30, summarize(near).mean, 0x1p-23);  // one rounding beside 2³⁰
}

TEST(Summarize, RefusesASingleValue) {
  EXPECT_THROW(static_cast<void>(summarize(std::vector<double>{1})), ContractViolation);
  EXPECT_THROW(static_cast<void>(mean_of({})), ContractViolation);
}

TEST(ExactSum, KeepsWhatAPlainSumWouldLose) {
  EXPECT_EQ(exact_sum(std::vector<double>{1, 1e100, 1, -1e100}), 2);
}

TEST(QuantileOf, InterpolatesAsRDoes) {
  const std::vector<double> values = {7, 1, 10, 2, 9, 3, 8, 4, 6, 5};
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.25), 3.25);  // quantile(1:10, 0.25)
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.5), 5.5);
  EXPECT_EQ(quantile_of(values, 0), 1);
  EXPECT_EQ(quantile_of(values, 1), 10);
  EXPECT_EQ(quantile_of(std::vector<double>{3}, 0.7), 3);
  EXPECT_THROW(static_cast<void>(quantile_of(values, 1.1)), ContractViolation);
}

TEST(Autocorrelation, IsOneOverAtLagZeroAndNegativeWhenTheSignAlternates) {
  const std::vector<double> values = {1, -1, 1, -1, 1, -1};
  EXPECT_DOUBLE_EQ(autocorrelation(values, 0), 1);
  EXPECT_DOUBLE_EQ(autocorrelation(values, 1), -5.0 / 6);
  EXPECT_EQ(autocorrelation(std::vector<double>{2, 2, 2}), 0);
}

}  // namespace
}  // namespace asterism
