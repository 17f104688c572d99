// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/genome.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/result.hpp"
#include "asterism/layout/metrics.hpp"

namespace asterism {
namespace {

LayoutRules rules_for_tests() {
  LayoutRules rules;
  rules.surface.patches.push_back({"room", CylinderRoom{{0, 0, 580}, 350, 40, 0.3}});
  rules.surface.keep_outs.push_back({"eye", Capsule{{100, 0, 0}, {100, 0, 1000}, 40}, {}});
  rules.clearance_mm = 6;
  return rules;
}

void expect_sound(const std::vector<Vec3>& layout, const LayoutRules& rules) {
  EXPECT_GE(static_cast<int>(layout.size()), rules.fewest);
  EXPECT_LE(static_cast<int>(layout.size()), rules.most);
  for (const Vec3& target : layout) {
    EXPECT_LT((nearest_place(rules.surface, target).position_mm - target).norm(), 1e-6);
    EXPECT_FALSE(kept_out(rules.surface, target, rules.clearance_mm - 1e-3));
  }
  EXPECT_GE(measure_layout(layout).min_pair_distance_mm, rules.spacing_mm);
  auto ordered = layout;
  put_in_order(ordered);
  EXPECT_EQ(genes_of(ordered), genes_of(layout));
}

TEST(Repair, BringsAnyLayoutToTheSurfaceAndApart) {
  const LayoutRules rules = rules_for_tests();
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    RandomStream random(31, trial);
    std::vector<Vec3> layout;
    const std::uint32_t targets = random.below(20);
    for (std::uint32_t i = 0; i < targets; ++i) {
      const double side = trial % 2 == 0 ? 600 : 50;
      layout.emplace_back(random.uniform(-side, side), random.uniform(-side, side), random.uniform(0, 900));
    }
    repair(layout, rules, random);
    expect_sound(layout, rules);
  }
}

TEST(Repair, LeavesASoundLayoutAsItIsButForItsOrder) {
  LayoutRules rules = rules_for_tests();
  rules.surface.keep_outs.clear();
  RandomStream random(32, 0);
  auto layout = paper_table1()[1].targets;
  repair(layout, rules, random);
  auto expected = paper_table1()[1].targets;
  put_in_order(expected);
  EXPECT_EQ(genes_of(layout), genes_of(expected));
}

TEST(Repair, LeavesTargetsOutWhereThereIsNoRoom) {
  LayoutRules rules = rules_for_tests();
  rules.surface = {{{"strip", Plate{{}, 560, 1}}}, {}};
  RandomStream random(33, 0);
  std::vector<Vec3> layout(12, Vec3::Zero());
  repair(layout, rules, random);
  EXPECT_LE(layout.size(), 6U);  // 560 mm take six at 100 mm
  EXPECT_GE(layout.size(), 4U);
}

TEST(SpreadApart, FindsADensePackingAndSaysWhenItCannot) {
  LayoutRules rules = rules_for_tests();
  rules.surface = {{{"disc", Annulus{{0, 0, 600}, 0, 104}}}, {}};  // 100 takes six about one, exactly
  int found = 0;
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    RandomStream random(38, trial);
    const auto layout = spread_apart(7, rules, random);
    if (!layout) continue;
    ++found;
    EXPECT_GE(measure_layout(*layout).min_pair_distance_mm, 100);
    EXPECT_FALSE(spread_apart(8, rules, random));
  }
  EXPECT_GE(found, 1);
}

TEST(CutAndJoin, KeepsEveryTargetOfBothParents) {
  const auto& mother = paper_table1()[0].targets;
  const auto& father = paper_table9()[2].targets;
  for (std::uint64_t trial = 0; trial < 50; ++trial) {
    RandomStream random(34, trial);
    std::vector<Vec3> daughter, son, all(mother), children;
    cut_and_join(mother, father, daughter, son, random);
    all.insert(all.end(), father.begin(), father.end());
    children = daughter;
    children.insert(children.end(), son.begin(), son.end());
    put_in_order(all);
    put_in_order(children);
    EXPECT_EQ(genes_of(all), genes_of(children));
  }
}

TEST(CrossMatched, CrossesTheNearestAndKeepsWhatHasNoPartner) {
  const auto& mother = paper_table1()[0].targets;
  const auto& father = paper_table9()[0].targets;  // its first four targets
  const Bounds bounds = {{-350, -350, 580}, {350, 350, 620}};
  RandomStream random(35, 0);
  std::vector<Vec3> daughter, son;
  cross_matched(mother, father, bounds, Variation(), daughter, son, random);
  ASSERT_EQ(daughter.size(), 6U);
  ASSERT_EQ(son.size(), 4U);
  put_in_order(daughter);
  auto expected = mother;
  put_in_order(expected);
  EXPECT_EQ(genes_of(daughter), genes_of(expected));  // equal pairs have equal children
}

TEST(Mutate, AddsRemovesAndMoves) {
  const LayoutRules rules = rules_for_tests();
  const Bounds bounds = bounds_of(rules.surface);
  int more = 0, fewer = 0, moved = 0;
  for (std::uint64_t trial = 0; trial < 1000; ++trial) {
    RandomStream random(36, trial);
    auto layout = paper_table1()[2].targets;
    mutate(layout, rules, bounds, Variation(), {}, random);
    more += layout.size() == 7 ? 1 : 0;
    fewer += layout.size() == 5 ? 1 : 0;
    moved += layout.size() == 6 && genes_of(layout) != genes_of(paper_table1()[2].targets) ? 1 : 0;
    repair(layout, rules, random);
    expect_sound(layout, rules);
  }
  EXPECT_NEAR(more, 80, 40);
  EXPECT_NEAR(fewer, 80, 40);
  EXPECT_GT(moved, 500);
}

TEST(PositionsOf, GenesAreTheSameAgain) {
  const auto& layout = paper_table1()[0].targets;
  EXPECT_EQ(positions_of(genes_of(layout)), layout);
  EXPECT_THROW(positions_of(std::vector<double>(7)), ContractViolation);
}

TEST(MovingCost, IsTheLeastOverAllAssignments) {
  for (std::uint64_t trial = 0; trial < 30; ++trial) {
    RandomStream random(37, trial);
    std::vector<Vec3> from, to;
    for (int i = 0; i < 6; ++i) {
      from.emplace_back(random.uniform(), random.uniform(), random.uniform());
      to.emplace_back(random.uniform(), random.uniform(), random.uniform());
    }
    std::vector<std::size_t> order(6);
    std::iota(order.begin(), order.end(), 0);
    double least = 1e9;
    do {
      double sum = 0;
      for (std::size_t i = 0; i < 6; ++i) sum += (from[i] - to[order[i]]).norm();
      least = std::min(least, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_NEAR(moving_cost_mm(from, to, 100), least, 1e-9);
  }
}

TEST(MovingCost, CountsWhatIsAddedAndTakenAway) {
  const std::vector<Vec3> from = {{0, 0, 0}, {100, 0, 0}};
  const std::vector<Vec3> to = {{100, 0, 0}, {0, 10, 0}, {500, 0, 0}};
  EXPECT_NEAR(moving_cost_mm(from, to, 300), 310, 1e-9);
  EXPECT_NEAR(moving_cost_mm(to, from, 300), 310, 1e-9);
  EXPECT_NEAR(moving_cost_mm(from, {}, 300), 600, 1e-9);
  EXPECT_NEAR(moving_cost_mm({}, {}, 300), 0, 1e-9);
}

}  // namespace
}  // namespace asterism
