// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/real_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

const std::vector<double> kLowest{-1, 0, 10};
const std::vector<double> kHighest{1, 5, 11};

TEST(Variation, KeepsGenesWithinTheirBounds) {
  const Variation variation;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    RandomStream random(7, i);
    std::vector<double> mother(3), father(3), daughter, son;
    for (std::size_t k = 0; k < 3; ++k) {
      // Parents at the bounds too, where the factors have their poles.
      mother[k] = i % 3 == 0 ? kLowest[k] : random.uniform(kLowest[k], kHighest[k]);
      father[k] = i % 5 == 0 ? kHighest[k] : random.uniform(kLowest[k], kHighest[k]);
    }
    variation.cross(mother, father, kLowest, kHighest, daughter, son, random);
    variation.mutate(daughter, kLowest, kHighest, random);
    variation.mutate(son, kLowest, kHighest, random);
    for (const auto& child : {daughter, son}) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GE(child[k], kLowest[k]);
        EXPECT_LE(child[k], kHighest[k]);
      }
    }
  }
}

// Far from the bounds the distance of the children in that of the parents, β, has the distribution
// P(β ≤ b) = ½ b^21 for b ≤ 1 and 1 − ½ b^−21 above (Deb & Agrawal 1995).
TEST(Variation, SpreadsChildrenAsSimulatedBinaryCrossoverStates) {
  const Variation variation({.crossover_probability = 1, .mutations = 0});
  const std::vector<double> mother{-0.5}, father{0.5}, low{-1e6}, high{1e6};
  std::vector<double> daughter, son;
  const int draws = 40000;
  int crossed = 0, below_95 = 0, below_100 = 0, below_105 = 0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    RandomStream random(3, i);
    variation.cross(mother, father, low, high, daughter, son, random);
    const double spread = std::abs(daughter[0] - son[0]);
    if (spread == 1) continue;
    ++crossed;
    below_95 += spread < 0.95;
    below_100 += spread < 1;
    below_105 += spread < 1.05;
  }
  const double five_sigma = 5 * 0.5 / std::sqrt(20000.0);
  EXPECT_NEAR(crossed / static_cast<double>(draws), 0.5, five_sigma);
  EXPECT_NEAR(below_95 / static_cast<double>(crossed), 0.5 * std::pow(0.95, 21), five_sigma);
  EXPECT_NEAR(below_100 / static_cast<double>(crossed), 0.5, five_sigma);
  EXPECT_NEAR(below_105 / static_cast<double>(crossed), 1 - 0.5 * std::pow(1.05, -21), five_sigma);
}

TEST(Variation, MutatesSoManyGenesOnAverage) {
  const Variation variation;
  const std::vector<double> low(30, 0.0), high(30, 1.0);
  std::vector<int> hits(30);
  for (std::uint64_t i = 0; i < 30000; ++i) {
    RandomStream random(5, i);
    std::vector<double> genes(30, 0.25);
    variation.mutate(genes, low, high, random);
    for (std::size_t k = 0; k < 30; ++k) hits[k] += genes[k] != 0.25;
  }
  for (const int hit : hits) EXPECT_NEAR(hit, 1000, 5 * std::sqrt(1000.0));
}

// Bounded polynomial mutation of a gene at 0.25 of [0, 1]: P(step ≤ −δ) from its definition.
TEST(Variation, MutatesAsPolynomialMutationStates) {
  const Variation variation({.mutations = 1});
  const std::vector<double> low{0.0}, high{1.0};
  int below = 0, above = 0;
  const int draws = 40000;
  for (std::uint64_t i = 0; i < draws; ++i) {
    RandomStream random(6, i);
    std::vector<double> genes{0.25};
    variation.mutate(genes, low, high, random);
    below += genes[0] < 0.22;
    above += genes[0] > 0.28;
  }
  const double outside_low = std::pow(0.75, 21), outside_high = std::pow(0.25, 21);
  const double p_below = 0.5 * (std::pow(0.97, 21) - outside_low) / (1 - outside_low);
  const double p_above = 0.5 * (std::pow(0.97, 21) - outside_high) / (1 - outside_high);
  EXPECT_NEAR(below / static_cast<double>(draws), p_below, 5 * 0.45 / 200);
  EXPECT_NEAR(above / static_cast<double>(draws), p_above, 5 * 0.45 / 200);
}

TEST(Variation, PaperAverageMakesEveryChildTheMean) {
  const Variation variation({.crossover = Crossover::PaperAverage});
  std::vector<double> daughter, son;
  RandomStream random(1, 1);
  variation.cross(std::vector<double>{-1, 2, 10}, std::vector<double>{1, 4, 11}, kLowest, kHighest, daughter,
                  son, random);
  EXPECT_EQ(daughter, (std::vector<double>{0, 3, 10.5}));
  EXPECT_EQ(son, daughter);
}

class Square : public RealProblem {
 public:
  using RealProblem::RealProblem;
  [[nodiscard]] std::string identity() const override { return "square"; }
  [[nodiscard]] std::vector<ObjectiveInfo> objectives() const override { return {{"x²", ""}}; }
  void evaluate(std::span<const double> genes, std::span<double> objectives,
                std::span<double>) const override {
    objectives[0] = genes[0] * genes[0];
  }
};

TEST(RealProblem, SamplesWithinItsBounds) {
  const Square problem(kLowest, kHighest);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    RandomStream random(1, i);
    const Genes genes = problem.sample(random);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(genes[k] >= kLowest[k] && genes[k] <= kHighest[k]);
  }
}

TEST(RealProblem, RefusesBoundsThatHoldNothing) {
  try {
    const Square problem({0, 2}, {1, 1});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "gene 2 has the bounds 2 and 1: the first must not exceed the second");
  }
  EXPECT_THROW(Square({0}, {std::numeric_limits<double>::infinity()}), InputError);
}

}  // namespace
}  // namespace asterism
