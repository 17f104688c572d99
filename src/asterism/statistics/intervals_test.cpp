// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/intervals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

std::vector<double> normal_sample(std::uint64_t seed, std::size_t count) {
  RandomStream random(seed, 0);
  std::vector<double> values(count);
  for (double& value : values) value = random.normal();
  return values;
}

TEST(MeanInterval, HoldsTheTrueMeanAsOftenAsItSays) {
  int held = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    held += mean_interval(summarize(normal_sample(seed, 5)), 0.9).holds(0);
  }
  EXPECT_NEAR(held / 2000.0, 0.9, 4 * std::sqrt(0.09 / 2000));  // four standard errors
}

TEST(MeanInterval, IsUndoneBySampleOfInterval) {
  const Summary sample = summarize(normal_sample(7, 50));
  const Summary back = sample_of_interval(mean_interval(sample), 50);
  EXPECT_NEAR(back.mean, sample.mean, 1e-14);
  EXPECT_NEAR(back.deviation, sample.deviation, 1e-13);
}

TEST(MeanInterval, RefusesASingleValueAndAConfidenceOfOne) {
  EXPECT_THROW(static_cast<void>(mean_interval(Summary{1, 0, 1, 0, 0})), ContractViolation);
  EXPECT_THROW(static_cast<void>(mean_interval(Summary{3, 0, 1, 0, 0}, 1)), ContractViolation);
}

TEST(ChiSquareMeanBand, IsTheBandOfTheMeanNees) {
  // Bar-Shalom, Li & Kirubarajan 2001, example 5.4.2-1: 50 runs of two degrees, 95 %: [1.5, 2.6].
  const Interval band = chi_square_mean_band(50, 2);
  EXPECT_NEAR(band.low, 1.484, 1e-3);
  EXPECT_NEAR(band.high, 2.591, 1e-3);
}

TEST(DeviationRatioBand, HoldsTheRatioAsOftenAsItSays) {
  const Interval band = deviation_ratio_band(20);
  int held = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    held += band.holds(summarize(normal_sample(seed, 20)).deviation);
  }
  EXPECT_NEAR(held / 2000.0, 0.95, 4 * std::sqrt(0.0475 / 2000));
}

TEST(BootstrapInterval, HoldsTheMeanOfASkewSampleAboutAsOftenAsItSays) {
  const Statistic mean = [](std::span<const double> values) { return mean_of(values); };
  int held = 0;
  constexpr int kRuns = 300;
  for (int run = 0; run < kRuns; ++run) {
    RandomStream random(3, static_cast<std::uint64_t>(run));
    std::vector<double> values(60);
    for (double& value : values) value = -std::log1p(-random.uniform());  // exponential, mean 1
    held += bootstrap_interval(values, mean, {.confidence = 0.9, .resamples = 400, .seed = 1}).holds(1);
  }
  // At 60 skew values a second-order interval is within 2 % of its level.
  EXPECT_NEAR(held / static_cast<double>(kRuns), 0.9, 0.02 + 3 * std::sqrt(0.09 / kRuns));
}

TEST(BootstrapInterval, GivesTheSameBitsForAnyThreadCountAndHoldsTheMedian) {
  const std::vector<double> values = normal_sample(5, 101);
  const Statistic median = [](std::span<const double> draw) { return quantile_of(draw, 0.5); };
  set_thread_count(1);
  const Interval one = bootstrap_interval(values, median);
  set_thread_count(0);
  const Interval many = bootstrap_interval(values, median);
  EXPECT_EQ(one.low, many.low);
  EXPECT_EQ(one.high, many.high);
  EXPECT_TRUE(one.holds(quantile_of(values, 0.5)));
}

TEST(BootstrapInterval, HasNoWidthWhenNothingVaries) {
  const std::vector<double> values = {2, 2, 2, 2};
  const Interval interval =
      bootstrap_interval(values, [](std::span<const double> draw) { return mean_of(draw); });
  EXPECT_EQ(interval.low, 2);
  EXPECT_EQ(interval.high, 2);
}

}  // namespace
}  // namespace asterism
