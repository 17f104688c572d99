// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/congruence_margin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

using Layout = std::vector<Vec3>;

// Machines 2025, 13, 592, Table 9; S4.P2 with the sign that its other figures need.
const std::vector<Layout> kTable9 = {
    {{250, 0, 600}, {0, 300, 610}, {-250, 0, 590}, {0, -300, 605}},
    {{350, 350, 600}, {-350, 350, 610}, {-350, -350, 590}, {350, -350, 605}},
    {{500, 0, 620}, {0, 680, 600}, {-500, 0, 610}, {0, -680, 605}},
    {{220, 220, 580}, {220, -220, 590}, {-220, 220, 595}, {-220, -220, 605}},
    {{600, 100, 610}, {100, 600, 600}, {-600, -100, 590}, {-100, -600, 620}}};
// The same, Table 1.
const std::vector<Layout> kTable1 = {
    {{250, 0, 600}, {0, 300, 610}, {-250, 0, 590}, {0, -300, 605}, {220, 220, 580}, {-220, -220, 605}},
    {{300, 100, 610},
     {100, 320, 620},
     {-300, 80, 590},
     {-120, -280, 600},
     {230, 240, 590},
     {-240, -200, 610}},
    {{200, -100, 590},
     {-100, 300, 610},
     {-200, 100, 600},
     {0, -250, 605},
     {210, 180, 580},
     {-200, -240, 590}}};

/// The least margin when `seen` targets of a layout are seen, whichever they are.
double worst_margin(const Layout& layout, std::size_t seen) {
  double worst = 1e9;
  std::vector<bool> chosen(layout.size());
  std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(seen), true);
  do {
    Layout points;
    std::vector<int> right;
    for (std::size_t i = 0; i < layout.size(); ++i) {
      if (!chosen[i]) continue;
      points.push_back(layout[i]);
      right.push_back(static_cast<int>(i));
    }
    const auto search = best_wrong_labelling(points, layout, right, worst);
    EXPECT_TRUE(search.complete);
    if (search.best) worst = search.best->rms_mm;
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return worst;
}

TEST(BestWrongLabelling, ShowsThatThePapersFourTargetLayoutsFitThemselvesTurned) {
  const std::vector<double> expected = {0.27, 0.05, 0.13, 0.0, 0.0};
  for (std::size_t i = 0; i < kTable9.size(); ++i) {
    EXPECT_NEAR(worst_margin(kTable9[i], 4), expected[i], 0.005) << "S" << i + 1;
  }
}

TEST(BestWrongLabelling, GivesTheMarginsOfThePapersSixTargetLayouts) {
  const std::vector<std::vector<double>> expected = {
      {14.2, 12.1, 0.20}, {60.7, 31.8, 3.64}, {51.6, 46.8, 14.9}};
  for (std::size_t i = 0; i < kTable1.size(); ++i) {
    for (std::size_t hidden = 0; hidden < 3; ++hidden) {
      EXPECT_NEAR(worst_margin(kTable1[i], 6 - hidden), expected[i][hidden], 0.05)
          << "S" << i + 1 << ", " << hidden;
    }
  }
}

TEST(BestWrongLabelling, EqualsATrialOfAllPermutations) {
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    RandomStream random(5, trial);
    Layout layout;
    for (int i = 0; i < 6; ++i)
      layout.push_back(Vec3(random.uniform(), random.uniform(), random.uniform()) * 100);
    std::vector<int> right(6);
    std::iota(right.begin(), right.end(), 0);
    std::vector<int> label = right;
    double least = 1e9;
    while (std::next_permutation(label.begin(), label.end())) {
      Layout to;
      for (const int l : label) to.push_back(layout[static_cast<std::size_t>(l)]);
      least = std::min(least, fit_rigid_motion(layout, to)->rms);
    }
    const auto search = best_wrong_labelling(layout, layout, right, 1e9);
    ASSERT_TRUE(search.best);
    EXPECT_NEAR(search.best->rms_mm, least, 1e-9);
  }
}

TEST(BestWrongLabelling, FindsTheSameLayoutOnAnotherBodyWhereNoLabelIsRight) {
  const auto search = best_wrong_labelling(kTable1[2], kTable1[2], {}, 1e9);
  ASSERT_TRUE(search.best);
  EXPECT_LT(search.best->rms_mm, 1e-9);
}

TEST(BestWrongLabelling, DoesNotCountAMirrorImage) {
  Layout mirrored = kTable1[2];
  for (Vec3& point : mirrored) point.z() = 1000 * (point.z() - 595) + 595;  // far from flat
  Layout twin = mirrored;
  for (Vec3& point : twin) point.x() = -point.x();
  const auto search = best_wrong_labelling(mirrored, twin, {}, 1e9);
  ASSERT_TRUE(search.best);
  EXPECT_GT(search.best->rms_mm, 50);
}

TEST(BestWrongLabelling, LeavesItselfOutAboveTheCapAndWhenThePatternIsTooSmall) {
  const std::vector<int> right = {0, 1, 2, 3, 4, 5};
  EXPECT_FALSE(best_wrong_labelling(kTable1[0], kTable1[0], right, 14.0).best);
  EXPECT_FALSE(best_wrong_labelling(kTable1[0], kTable9[0], {}, 1e9).best);
}

TEST(BestWrongLabelling, SaysSoWhenItHasToStop) {
  const std::vector<int> right = {0, 1, 2, 3, 4, 5};
  EXPECT_FALSE(best_wrong_labelling(kTable1[0], kTable1[0], right, 1e9, 5).complete);
}

TEST(WrongLabellingsWithin, FindsAllThreeTurnsOfARectangle) {
  const Layout rectangle = {{0, 0, 0}, {100, 0, 0}, {100, 60, 0}, {0, 60, 0}};
  const auto wrong = wrong_labellings_within(rectangle, rectangle, std::vector<int>{0, 1, 2, 3}, 1.0);
  EXPECT_TRUE(wrong.complete);
  ASSERT_EQ(wrong.found.size(), 3U);
  for (const auto& labelling : wrong.found) EXPECT_LT(labelling.rms_mm, 1e-6);
}

TEST(BestWrongLabelling, NeedsThreePoints) {
  EXPECT_THROW(best_wrong_labelling(std::span(kTable1[0]).first(2), kTable1[0], {}, 1e9), ContractViolation);
}

}  // namespace
}  // namespace asterism
