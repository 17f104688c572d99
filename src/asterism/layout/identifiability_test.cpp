// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/identifiability.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/congruence_margin.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {
namespace {

TEST(IdentifiabilityMargin, ShowsThatThePapersFourTargetLayoutsFitThemselvesTurned) {
  const std::vector<double> expected = {0.27, 0.05, 0.13, 0.0, 0.0};
  for (std::size_t s = 0; s < 5; ++s) {
    const auto margin = identifiability_margin(paper_table9()[s].targets);
    EXPECT_NEAR(margin.rms_mm, expected[s], 0.005) << "S" << s + 1;
    EXPECT_TRUE(margin.complete);
    EXPECT_EQ(margin.seen, (std::vector<int>{0, 1, 2, 3}));
  }
}

TEST(IdentifiabilityMargin, GivesTheMarginsOfThePapersSixTargetLayouts) {
  // Six seen, five or more, four or more; the last is what a pose may be taken from.
  const std::vector<std::vector<double>> expected = {
      {14.2, 12.1, 0.20}, {60.7, 31.8, 3.64}, {51.6, 46.8, 14.9}};
  for (std::size_t s = 0; s < 3; ++s) {
    for (int fewest = 6; fewest >= 4; --fewest) {
      const auto margin = identifiability_margin(paper_table1()[s].targets, {fewest, 100.0});
      EXPECT_NEAR(margin.rms_mm, expected[s][static_cast<std::size_t>(6 - fewest)], 0.05)
          << "S" << s + 1 << ", " << fewest;
      EXPECT_GE(static_cast<int>(margin.seen.size()), fewest);
    }
  }
}

std::vector<Vec3> random_layout(std::uint64_t index, std::size_t targets, double side, double height) {
  RandomStream random(21, index);
  std::vector<Vec3> layout;
  for (std::size_t i = 0; i < targets; ++i) {
    layout.emplace_back(side * random.uniform(), side * random.uniform(), height * random.uniform());
  }
  return layout;
}

/// The least margin over all subsets, each by a search of its own.
double margin_by_subsets(const std::vector<Vec3>& layout, unsigned fewest, double cap, std::uint64_t within) {
  double least = cap;
  for (std::uint64_t mask = 0; mask < std::uint64_t{1} << layout.size(); ++mask) {
    if (std::popcount(mask) < static_cast<int>(fewest) || (mask & within) != mask) continue;
    std::vector<Vec3> points;
    std::vector<int> right;
    for (std::size_t i = 0; i < layout.size(); ++i) {
      if (!((mask >> i) & 1U)) continue;
      points.push_back(layout[i]);
      right.push_back(static_cast<int>(i));
    }
    const auto search = best_wrong_labelling(points, layout, right, least);
    EXPECT_TRUE(search.complete);
    if (search.best) least = search.best->rms_mm;
  }
  return least;
}

TEST(IdentifiabilityMargin, EqualsASearchOfEverySubset) {
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    // From crowded, where one of many seen is mistaken for its neighbour, to wide, from flat to tall.
    const double side = trial % 4 == 0 ? 25 : 120.0 * static_cast<double>(trial % 4);
    const auto layout = random_layout(trial, 4 + trial % 4, side, trial % 3 == 0 ? 0.0 : 0.4 * side);
    const std::uint64_t all = (std::uint64_t{1} << layout.size()) - 1;
    const auto margin = identifiability_margin(layout, {4, 40.0});
    EXPECT_NEAR(margin.rms_mm, margin_by_subsets(layout, 4, 40.0, all), 1e-6) << trial;
  }
}

TEST(IdentifiabilityMargin, OfManySeenCanBeSmallerThanOfFour) {
  // Two targets 8 mm apart among well spread ones: one for the other costs 8 mm in one of k residuals.
  std::vector<Vec3> layout = {{0, 0, 0},     {500, 30, 10},   {-320, 410, 60}, {-90, -470, 25},
                              {410, 330, 5}, {-440, -60, 80}, {120, 150, 40},  {120, 158, 40}};
  const auto margin = identifiability_margin(layout, {4, 40.0});
  EXPECT_EQ(margin.seen.size(), 7U);
  EXPECT_NEAR(margin.rms_mm, margin_by_subsets(layout, 4, 40.0, 255), 1e-6);
  EXPECT_LT(margin.rms_mm, 8 / std::sqrt(6.0));
}

TEST(IdentifiabilityMargin, AsksOnlyAboutWhatCanBeSeenTogether) {
  const auto layout = random_layout(5, 7, 300, 100);
  const std::vector<std::uint64_t> seen = {0b0111110, 0b1011011, 0b0001110};
  const double expected =
      std::min(margin_by_subsets(layout, 4, 60.0, seen[0]), margin_by_subsets(layout, 4, 60.0, seen[1]));
  EXPECT_NEAR(identifiability_margin(layout, {4, 60.0}, seen).rms_mm, expected, 1e-6);
}

TEST(IdentifiabilityMargin, EqualsASearchOfEverySubsetUnderRandomSights) {
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const auto layout = random_layout(100 + trial, 7, 250, 60);
    RandomStream random(22, trial);
    std::vector<std::uint64_t> seen;
    double expected = 60;
    for (int mask = 0; mask < 3; ++mask) {
      seen.push_back(random.below(128));
      expected = std::min(expected, margin_by_subsets(layout, 4, 60.0, seen.back()));
    }
    const auto margin = identifiability_margin(layout, {4, 60.0}, seen);
    EXPECT_NEAR(margin.rms_mm, expected, 1e-6) << trial;
    std::uint64_t labelled = 0;
    for (const int target : margin.seen) labelled |= std::uint64_t{1} << target;
    EXPECT_TRUE(std::any_of(seen.begin(), seen.end(),
                            [&](std::uint64_t mask) { return (mask & labelled) == labelled; }));
  }
}

TEST(IdentifiabilityMargin, StaysTheSameWhenTheWholeLayoutIsMoved) {
  const RigidMotion moved = {exp_rotation({0.4, -1.1, 0.7}), Vec3(10, -2000, 300)};
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const auto layout = random_layout(trial, 8, 700, 40);
    std::vector<Vec3> elsewhere;
    for (const Vec3& target : layout) elsewhere.push_back(moved * target);
    EXPECT_NEAR(identifiability_margin(layout).rms_mm, identifiability_margin(elsewhere).rms_mm, 1e-6);
  }
}

TEST(IdentifiabilityMargin, StopsAtItsCapAndSaysWhenItGaveUp) {
  const auto& s3 = paper_table1()[2].targets;
  const auto capped = identifiability_margin(s3);
  EXPECT_EQ(capped.rms_mm, 10.0);
  EXPECT_TRUE(capped.seen.empty());
  EXPECT_TRUE(capped.complete);
  EXPECT_FALSE(identifiability_margin(s3, {4, 100.0, 20}).complete);
  EXPECT_EQ(identifiability_margin(std::span(s3).first(3)).rms_mm, 10.0);  // a pose needs four
}

TEST(IdentifiabilityMargin, NeedsThreeSeen) {
  EXPECT_THROW(identifiability_margin(paper_table1()[0].targets, {2, 1.0}), ContractViolation);
}

TEST(IdentifiabilityBetween, FindsTheSameLayoutOnAnotherBody) {
  const auto& s3 = paper_table1()[2].targets;
  std::vector<Vec3> copy;
  const RigidMotion moved = {exp_rotation({0.4, -1.1, 0.7}), Vec3(10, -200, 300)};
  for (std::size_t i = 0; i < s3.size(); ++i) copy.push_back(moved * s3[(i + 2) % s3.size()]);
  const auto margin = identifiability_between(s3, copy);
  EXPECT_LT(margin.rms_mm, 1e-6);
  for (std::size_t i = 0; i < margin.seen.size(); ++i) {
    EXPECT_EQ((margin.taken_for[i] + 2) % 6, margin.seen[i]);
  }
}

TEST(IdentifiabilityBetween, EqualsASearchOfEverySubsetAndIsTheSameBothWays) {
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const auto a = random_layout(2 * trial, 6, 200, 50);
    const auto b = random_layout(2 * trial + 1, 5, 200, 50);
    double least = 80;
    for (unsigned mask = 0; mask < 64; ++mask) {
      std::vector<Vec3> points;
      for (std::size_t i = 0; i < 6; ++i) {
        if ((mask >> i) & 1U) points.push_back(a[i]);
      }
      if (points.size() < 4) continue;
      const auto search = best_wrong_labelling(points, b, {}, least);
      if (search.best) least = search.best->rms_mm;
    }
    EXPECT_NEAR(identifiability_between(a, b, {4, 80.0}).rms_mm, least, 1e-6);
    EXPECT_NEAR(identifiability_between(b, a, {4, 80.0}).rms_mm, least, 1e-6);
  }
}

}  // namespace
}  // namespace asterism
