// SPDX-License-Identifier: Apache-2.0
#include "asterism/core/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

TEST(RandomStream, GivesThePublishedPhiloxNumbers) {
  // Random123's known answer for Philox 4×32-10: counter 0, key 0.
  RandomStream random(0, 0, 0);
  EXPECT_EQ(random.bits(), 0x6627e8d5U);
  EXPECT_EQ(random.bits(), 0xe169c58dU);
  EXPECT_EQ(random.bits(), 0xbc57ac4cU);
  EXPECT_EQ(random.bits(), 0x9b00dbd8U);
}

TEST(RandomStream, DiffersWithSeedIndexAndPurpose) {
  const auto first = [](std::uint64_t seed, std::uint64_t index, std::uint32_t purpose) {
    return RandomStream(seed, index, purpose).bits();
  };
  EXPECT_NE(first(1, 2, 3), first(2, 2, 3));
  EXPECT_NE(first(1, 2, 3), first(1, 3, 3));
  EXPECT_NE(first(1, 2, 3), first(1, 2, 4));
}

// Means and variances of n draws; each bound is five standard errors.
void expect_moments(double (*draw)(RandomStream&), double mean, double variance, double fourth_central) {
  constexpr int kDraws = 200000;
  RandomStream random(7, 0);
  double sum = 0, squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = draw(random) - mean;
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0, 5 * std::sqrt(variance / kDraws));
  EXPECT_NEAR(squares / kDraws, variance, 5 * std::sqrt((fourth_central - variance * variance) / kDraws));
}

TEST(RandomStream, DrawsHaveTheirMoments) {
  expect_moments([](RandomStream& r) { return r.uniform(); }, 0.5, 1.0 / 12, 1.0 / 80);
  expect_moments([](RandomStream& r) { return r.normal(); }, 0, 1, 3);
  expect_moments([](RandomStream& r) { return r.poisson(3.5); }, 3.5, 3.5, 3.5 + 3 * 3.5 * 3.5);
  expect_moments([](RandomStream& r) { return r.poisson(240); }, 240, 240, 240 + 3.0 * 240 * 240);
  expect_moments([](RandomStream& r) { return static_cast<double>(r.below(5)); }, 2, 2, 6.8);
}

TEST(ParallelFor, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto run = [](int threads) {
    set_thread_count(threads);
    std::vector<double> values(1000);
    parallel_for(values.size(), [&](std::size_t i) { values[i] = RandomStream(3, i).normal(); });
    set_thread_count(0);
    return values;
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(ParallelFor, ThrowsOnWhatABodyThrew) {
  EXPECT_THROW(parallel_for(10,
                            [](std::size_t i) {
                              if (i == 7) throw std::runtime_error("seven");
                            }),
               std::runtime_error);
}

}  // namespace
}  // namespace asterism
