// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/congruence.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {
namespace {

constexpr double kSigma = 0.1;

UncertainPoint at(const Vec3& position) { return {position, kSigma * kSigma * Mat3::Identity()}; }

const std::vector<UncertainPoint> kPattern = {{{0, 0, 0}, Mat3::Zero()},
                                              {{100, 0, 0}, Mat3::Zero()},
                                              {{0, 170, 0}, Mat3::Zero()},
                                              {{30, 40, 260}, Mat3::Zero()}};

std::vector<UncertainPoint> moved_pattern(const RigidMotion& a_from_b) {
  std::vector<UncertainPoint> scene;
  for (const auto& point : kPattern) scene.push_back(at(a_from_b * point.position));
  return scene;
}

Cliques search(std::span<const UncertainPoint> scene, std::span<const Claims> claims = {}) {
  const PairDistanceTable table(std::span(&kPattern, 1));
  const auto pairs = table.match(scene, claims, 5.0, 100000);
  return grow_cliques(pairs.of_pattern[0], kPattern.size(), scene.size());
}

const RigidMotion kMotion{exp_rotation(Vec3(0.4, -1.1, 2.0)), Vec3(300, -50, 2100)};

TEST(PairDistanceTable, MatchesOnlyWhatTheCovariancesAllow) {
  const std::vector<std::vector<UncertainPoint>> patterns = {{kPattern[0], kPattern[1]}};
  const PairDistanceTable table(patterns);
  const auto matches = [&](double apart) {
    const std::vector<UncertainPoint> scene = {at({0, 0, 1000}), at({0, apart, 1000})};
    return table.match(scene, {}, 5.0, 100).of_pattern[0].size();
  };
  EXPECT_EQ(matches(100), 2U) << "both ways round";
  EXPECT_EQ(matches(100.70), 2U) << "5 √2 σ = 0.707 mm";
  EXPECT_EQ(matches(100.72), 0U);
  EXPECT_EQ(matches(99.29), 0U);
}

TEST(PairDistanceTable, WidensOnlyAlongTheDirectionInWhichPointsAreUncertain) {
  const std::vector<std::vector<UncertainPoint>> patterns = {{kPattern[0], kPattern[1]}};
  const PairDistanceTable table(patterns);
  const Mat3 deep = Vec3(0.01, 0.01, 1.0).asDiagonal();
  const auto matches = [&](const Vec3& apart) {
    const std::vector<UncertainPoint> scene = {{Vec3::Zero(), deep}, {apart, deep}};
    return table.match(scene, {}, 5.0, 100).of_pattern[0].size();
  };
  EXPECT_EQ(matches({0, 0, 105}), 2U);
  EXPECT_EQ(matches({105, 0, 0}), 0U);
}

TEST(PairDistanceTable, SaysSoWhenThereAreTooManyPairsToList) {
  const PairDistanceTable table(std::span(&kPattern, 1));
  EXPECT_FALSE(table.match(moved_pattern(kMotion), {}, 5.0, 4).complete);
}

TEST(GrowCliques, FindsAPatternAmongRandomPointsAfterAnyMotion) {
  RandomStream random(3, 0);
  auto scene = moved_pattern(kMotion);
  for (int i = 0; i < 40; ++i) {
    scene.push_back(
        at(kMotion * Vec3(random.uniform(-500, 500), random.uniform(-500, 500), random.uniform(-500, 500))));
  }
  const Cliques cliques = search(scene);
  ASSERT_TRUE(cliques.complete);
  const auto whole =
      std::find_if(cliques.found.begin(), cliques.found.end(), [](const auto& c) { return c.size() == 4; });
  ASSERT_NE(whole, cliques.found.end());
  for (int i = 0; i < 4; ++i) EXPECT_EQ((*whole)[static_cast<std::size_t>(i)], (Correspondence{i, i}));
}

TEST(GrowCliques, FindsMirrorImagesTooSinceDistancesCannotTellThem) {
  auto scene = moved_pattern(kMotion);
  for (auto& point : scene) point.position.x() = -point.position.x();
  EXPECT_EQ(search(scene).found.size(), 1U);
}

TEST(GrowCliques, NeverJoinsPointsThatShareAClaim) {
  const std::vector<Claims> claims = {{0, 0}, {1, 1}, {2, 2}, {0, 3}};
  const Cliques cliques = search(moved_pattern(kMotion), claims);
  ASSERT_EQ(cliques.found.size(), 2U);
  for (const auto& clique : cliques.found) EXPECT_EQ(clique.size(), 3U);
}

TEST(GrowCliques, FindsAllMaximalCliquesOfAKnownGraph) {
  // Correspondences i→i; 0123 and 345 are complete, 56 is too small.
  const auto pair = [](int a, int b) { return CompatiblePair{{a, a}, {b, b}}; };
  const std::vector<CompatiblePair> pairs = {pair(0, 1), pair(0, 2), pair(0, 3), pair(1, 2), pair(1, 3),
                                             pair(2, 3), pair(3, 4), pair(3, 5), pair(4, 5), pair(5, 6)};
  auto found = grow_cliques(pairs, 7, 7).found;
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0], (std::vector<Correspondence>{{0, 0}, {1, 1}, {2, 2}, {3, 3}}));
  EXPECT_EQ(found[1], (std::vector<Correspondence>{{3, 3}, {4, 4}, {5, 5}}));
}

TEST(GrowCliques, StopsAtItsLimitsAndSaysSo) {
  // A complete 8-partite graph with 3 nodes a part has 3⁸ maximal cliques.
  std::vector<CompatiblePair> pairs;
  for (int a = 0; a < 24; ++a) {
    for (int b = 0; b < a; ++b) {
      if (a / 3 != b / 3) pairs.push_back({{a / 3, a}, {b / 3, b}});
    }
  }
  const Cliques cliques = grow_cliques(pairs, 8, 24);
  EXPECT_FALSE(cliques.complete);
  EXPECT_LE(cliques.found.size(), CliqueLimits{}.max_cliques);
  CliqueLimits enough;
  enough.max_cliques = 10000;
  EXPECT_EQ(grow_cliques(pairs, 8, 24, enough).found.size(), 6561U);
}

TEST(GrowCliques, NeedsCliquesOfTwoAtLeast) {
  CliqueLimits limits;
  limits.min_size = 1;
  EXPECT_THROW(grow_cliques({}, 3, 3, limits), ContractViolation);
}

}  // namespace
}  // namespace asterism
