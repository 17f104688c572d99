// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/survival.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

std::vector<std::uint32_t> indices(std::span<const Survivor> survivors) {
  std::vector<std::uint32_t> list;
  for (const Survivor& s : survivors) list.push_back(s.index);
  return list;
}

std::vector<double> random_points(std::size_t count, std::size_t m, std::uint64_t seed) {
  RandomStream random(seed, 0);
  std::vector<double> points(count * m);
  for (double& x : points) x = random.uniform();
  return points;
}

/// The front's dominated area up to the corner of its two ends.
double area(const std::vector<double>& points, std::vector<std::uint32_t> front) {
  std::ranges::sort(front, {}, [&](std::uint32_t i) { return points[2 * i]; });
  double sum = 0;
  for (std::size_t i = 1; i < front.size(); ++i)
    sum += (points[2 * front.back()] - points[2 * front[i]]) *
           (points[2 * front[i - 1] + 1] - points[2 * front[i] + 1]);
  return sum;
}

std::vector<double> curved_front(std::size_t count, std::uint64_t seed) {
  auto points = random_points(count, 2, seed);
  for (std::size_t i = 0; i < count; ++i) points[2 * i + 1] = 1 - std::sqrt(points[2 * i]);
  return points;
}

TEST(SurvivorSelection, TakesFrontAfterFront) {
  const std::vector<double> points = {3, 3, 0, 1, 2, 2, 1, 0};  // ranks 2 0 1 0
  SurvivorSelection select;
  const auto survivors = select({points, 2}, 3);
  EXPECT_EQ(indices(survivors), (std::vector<std::uint32_t>{1, 3, 2}));
  EXPECT_EQ(survivors[0].rank, 0);
  EXPECT_EQ(survivors[2].rank, 1);
}

TEST(SurvivorSelection, PutsFeasibleOnesFirstAndThenTheLeastViolation) {
  const std::vector<double> points = {0, 0, 5, 5, 1, 1, 6, 6, 2, 2};
  const std::vector<double> violations = {0.5, 0, 0.2, 0, 0.5};
  SurvivorSelection select;
  const auto survivors = select({points, 2, violations}, 4);
  EXPECT_EQ(indices(survivors), (std::vector<std::uint32_t>{1, 3, 2, 0}));
  EXPECT_EQ(survivors[1].rank, 1);
  EXPECT_EQ(survivors[2].rank, 2);
  EXPECT_EQ(survivors[3].rank, 3);
}

TEST(SurvivorSelection, GivesEachNicheItsShareAndHandsOnWhatIsNotUsed) {
  const auto points = random_points(12, 2, 47);
  const std::vector<std::size_t> niches = {9, 4, 4, 4, 4, 4, 7, 7, 7, 7, 7, 7};
  SurvivorSelection select;
  const auto survivors = select({points, 2, {}, niches}, 8);
  std::vector<std::size_t> names;
  for (const Survivor& s : survivors) names.push_back(niches[s.index]);
  EXPECT_EQ(names, (std::vector<std::size_t>{4, 4, 4, 7, 7, 7, 7, 9}));
}

TEST(SurvivorSelection, RanksWithinTheNicheOnly) {
  const std::vector<double> points = {0, 0, 1, 1};
  const std::vector<std::size_t> niches = {0, 1};
  SurvivorSelection select;
  EXPECT_EQ(select({points, 2, {}, niches}, 2)[1].rank, 0);
}

TEST(SurvivorSelection, ThinsAFrontSoThatLittleHypervolumeIsLost) {
  const auto points = curved_front(12, 53);
  SurvivorSelection select(Survival::HypervolumeContribution);
  const auto kept = indices(select({points, 2}, 11));
  // Of one point that goes, the best choice is known.
  std::vector<std::uint32_t> all(12);
  for (std::uint32_t i = 0; i < 12; ++i) all[i] = i;
  double best = 0;
  for (std::uint32_t left_out = 0; left_out < 12; ++left_out) {
    auto rest = all;
    rest.erase(rest.begin() + left_out);
    if (points[2 * left_out] > points[2 * kept.front()] && points[2 * left_out] < points[2 * kept.back()])
      best = std::max(best, area(points, rest));
  }
  EXPECT_DOUBLE_EQ(area(points, kept), best);
}

TEST(SurvivorSelection, KeepsTheEndsOfAFront) {
  const auto points = curved_front(50, 59);
  for (const Survival how : {Survival::Crowding, Survival::HypervolumeContribution}) {
    SurvivorSelection select(how);
    const auto survivors = select({points, 2}, 10);
    double least = 1, most = 0;
    for (std::size_t i = 0; i < 50; ++i) {
      least = std::min(least, points[2 * i]);
      most = std::max(most, points[2 * i]);
    }
    EXPECT_EQ(points[2 * survivors.front().index], least);
    EXPECT_EQ(points[2 * survivors.back().index], most);
    EXPECT_EQ(survivors.front().spread, std::numeric_limits<double>::infinity());
  }
}

TEST(SurvivorSelection, KeepsOneOfEachCopyBeforeAnyTwo) {
  std::vector<double> points;
  for (int copy = 0; copy < 3; ++copy)
    for (const double x : {0.0, 0.3, 0.5, 1.0}) points.insert(points.end(), {x, 1 - x});
  SurvivorSelection select;
  std::set<double> kept;
  for (const Survivor& s : select({points, 2}, 4)) kept.insert(points[2 * s.index]);
  EXPECT_EQ(kept, (std::set{0.0, 0.3, 0.5, 1.0}));
}

TEST(SurvivorSelection, DoesNotDependOnTheOrderOfTheContenders) {
  const std::size_t count = 200;
  for (const Survival how :
       {Survival::Crowding, Survival::HypervolumeContribution, Survival::ReferencePoints})
    for (const std::size_t m : {2, 3}) {
      const auto points = random_points(count, m, 61);
      std::vector<double> reversed;
      for (std::size_t i = count; i-- > 0;)
        for (std::size_t k = 0; k < m; ++k) reversed.push_back(points[i * m + k]);
      SurvivorSelection select(how);
      const auto kept = indices(select({points, m}, 100));
      auto other = indices(select({reversed, m}, 100));
      for (auto& i : other) i = count - 1 - i;
      EXPECT_EQ(kept, other);
    }
}

TEST(SurvivorSelection, TakesEachWayForTheNumberOfObjectivesItIsMeantFor) {
  for (const std::size_t m : {1, 2, 3, 4, 7}) {
    const auto points = random_points(60, m, 63);
    SurvivorSelection automatic;
    SurvivorSelection expected(m == 1  ? Survival::Crowding
                               : m < 4 ? Survival::HypervolumeContribution
                                       : Survival::ReferencePoints);
    EXPECT_EQ(indices(automatic({points, m}, 30)), indices(expected({points, m}, 30)));
  }
}

TEST(SurvivorSelection, RefusesHypervolumeOfManyObjectives) {
  SurvivorSelection select(Survival::HypervolumeContribution);
  try {
    select({random_points(9, 4, 65), 4}, 3);
    FAIL() << "it took four objectives";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "survival: hypervolume contributions are known for two and three objectives, not for 4; "
                 "take automatic, reference points or crowding");
  }
}

TEST(SurvivorSelection, KeepsAllWhenMoreAreWantedThanThere) {
  const auto points = random_points(7, 2, 67);
  SurvivorSelection select;
  EXPECT_EQ(select({points, 2}, 20).size(), 7U);
  EXPECT_TRUE(select({{}, 2}, 20).empty());
}

}  // namespace
}  // namespace asterism
