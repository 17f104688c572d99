// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/non_dominated_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

bool dominates(std::span<const double> a, std::span<const double> b) {
  bool less = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] > b[k]) return false;
    less |= a[k] < b[k];
  }
  return less;
}

/// The textbook's: a front is what nobody left dominates.
std::vector<int> textbook_ranks(std::span<const double> objectives, std::size_t m) {
  const std::size_t count = objectives.size() / m;
  std::vector<int> rank(count, -1);
  std::size_t ranked = 0;
  for (int front = 0; ranked < count; ++front) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < count; ++i) {
      if (rank[i] >= 0) continue;
      bool dominated = false;
      for (std::size_t j = 0; j < count && !dominated; ++j)
        dominated = rank[j] < 0 && dominates(objectives.subspan(j * m, m), objectives.subspan(i * m, m));
      if (!dominated) members.push_back(i);
    }
    for (const std::size_t i : members) rank[i] = front;
    ranked += members.size();
  }
  return rank;
}

/// Points on a grid of `levels` values an objective: few levels make many ties and duplicates.
std::vector<double> tied_points(std::size_t count, std::size_t m, std::uint32_t levels,
                                RandomStream& random) {
  std::vector<double> points(count * m);
  for (double& x : points) x = random.below(levels);
  return points;
}

TEST(NonDominatedRanks, EqualTheTextbooksOnAThousandTiedSets) {
  NonDominatedSort sort;
  for (std::uint64_t set = 0; set < 1000; ++set) {
    RandomStream random(29, set);
    const std::size_t m = 1 + set % 6;
    const std::size_t count = 1 + random.below(set % 10 == 0 ? 300 : 60);
    const auto points = tied_points(count, m, 2 + random.below(set % 3 == 0 ? 1000 : 8), random);
    ASSERT_EQ(sort(points, m).rank, textbook_ranks(points, m)) << "set " << set << ", m " << m;
  }
}

TEST(NonDominatedRanks, EqualTheTextbooksOnValuesOfAllMagnitudes) {
  for (std::uint64_t set = 0; set < 60; ++set) {
    RandomStream random(31, set);
    const std::size_t m = 1 + set % 6;
    std::vector<double> points(200 * m);
    for (double& x : points)
      x = (random.uniform() - 0.5) * std::pow(10.0, random.uniform(-300, set % 2 ? 308 : 0));
    points[0] = std::numeric_limits<double>::max();
    points[m] = std::numeric_limits<double>::lowest();
    points[2 * m] = 0.0;
    points[3 * m] = -0.0;
    ASSERT_EQ(non_dominated_ranks(points, m), textbook_ranks(points, m)) << "set " << set << ", m " << m;
  }
}

TEST(NonDominatedRanks, DoNotDependOnTheOrderOfThePoints) {
  RandomStream random(37, 0);
  for (const std::size_t m : {2, 3, 4}) {
    const std::size_t count = 3000;
    const auto points = tied_points(count, m, 200, random);
    std::vector<double> reversed;
    for (std::size_t i = count; i-- > 0;)
      reversed.insert(reversed.end(), points.begin() + static_cast<std::ptrdiff_t>(i * m),
                      points.begin() + static_cast<std::ptrdiff_t>((i + 1) * m));
    auto ranks = non_dominated_ranks(reversed, m);
    std::ranges::reverse(ranks);
    EXPECT_EQ(ranks, non_dominated_ranks(points, m));
  }
}

TEST(NonDominatedRanks, TreatNoughtAndMinusNoughtAsEqual) {
  EXPECT_EQ(non_dominated_ranks(std::vector{0.0, 1.0, -0.0, 1.0}, 2), (std::vector{0, 0}));
}

TEST(NonDominatedRanks, OfNoPointsAreNone) { EXPECT_TRUE(non_dominated_ranks({}, 3).empty()); }

TEST(NonDominatedRanks, RefuseWhatIsNotANumber) {
  EXPECT_THROW(static_cast<void>(non_dominated_ranks(std::vector{0.0, std::nan("")}, 2)), ContractViolation);
}

TEST(NonDominatedSort, ListsEachFrontInLexicographicOrder) {
  RandomStream random(41, 0);
  for (const std::size_t m : {1, 2, 3, 5}) {
    const auto points = tied_points(500, m, 30, random);
    NonDominatedSort sort;
    const Fronts& fronts = sort(points, m);
    std::size_t listed = 0;
    for (std::size_t k = 0; k < fronts.count(); ++k) {
      const auto front = fronts.front(k);
      listed += front.size();
      for (std::size_t i = 0; i < front.size(); ++i) {
        ASSERT_EQ(fronts.rank[front[i]], static_cast<int>(k));
        if (i == 0) continue;
        const auto a = std::span(points).subspan(front[i - 1] * m, m);
        const auto b = std::span(points).subspan(front[i] * m, m);
        ASSERT_TRUE(std::ranges::lexicographical_compare(a, b) ||
                    (std::ranges::equal(a, b) && front[i - 1] < front[i]));
      }
    }
    EXPECT_EQ(listed, 500U);
  }
}

}  // namespace
}  // namespace asterism
