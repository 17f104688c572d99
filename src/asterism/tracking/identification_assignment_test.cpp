// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification_assignment.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

constexpr double kDecisive = 28;

Labelling labelling(int body, std::vector<Correspondence> labels, double cost, double rms_mm = 0.1) {
  Labelling made{body, std::move(labels), {}};
  made.cost = cost;
  made.fit.rms_mm = rms_mm;
  return made;
}

/// Targets 0, 1, 2, 3 are these points.
std::vector<Correspondence> points(const std::vector<int>& scene) {
  std::vector<Correspondence> labels;
  for (const int point : scene) labels.push_back({static_cast<int>(labels.size()), point});
  return labels;
}

std::vector<Choice> choose(const std::vector<Labelling>& labellings, std::size_t bodies) {
  const std::vector<Claims> claims(20, Claims{-1, -1});
  return choose_disjoint(labellings, claims, bodies, kDecisive, 4);
}

TEST(ChooseDisjoint, TakesTheBestOfEachBodyWhereNoneCompete) {
  const auto choices =
      choose({labelling(1, points({4, 5, 6, 7}), -90), labelling(0, points({0, 1, 2, 3}), -80),
              labelling(0, points({8, 9, 10, 11}), -20)},
             2);
  ASSERT_EQ(choices.size(), 2U);
  EXPECT_EQ(choices[0].labelling, 1U);
  EXPECT_EQ(choices[1].labelling, 0U);
  for (const auto& choice : choices) EXPECT_EQ(choice.status, LabelStatus::Ok);
}

TEST(ChooseDisjoint, GivesUpABodysBestWhereAllTogetherGainByIt) {
  // Body 0 alone would take the points that body 1 needs more.
  const auto choices =
      choose({labelling(0, points({0, 1, 2, 3}), -100), labelling(0, points({6, 7, 8, 9}), -90),
              labelling(1, points({3, 4, 5, 2}), -120)},
             2);
  ASSERT_EQ(choices.size(), 2U);
  EXPECT_EQ(choices[0].labelling, 1U);
  EXPECT_EQ(choices[1].labelling, 2U);
  EXPECT_EQ(choices[0].status, LabelStatus::Ok);
}

TEST(ChooseDisjoint, CallsABodyAmbiguousWhenAnotherLabellingIsNearlyAsGood) {
  const auto choices = choose(
      {labelling(0, points({0, 1, 2, 3}), -100, 0.10), labelling(0, points({1, 0, 3, 2}), -95, 0.13)}, 1);
  ASSERT_EQ(choices.size(), 1U);
  EXPECT_EQ(choices[0].status, LabelStatus::Ambiguous);
  EXPECT_EQ(choices[0].rival_rms_mm, 0.13);
}

TEST(ChooseDisjoint, KeepsWhatAllNearlyAsGoodAgreeOn) {
  const auto choices =
      choose({labelling(0, points({0, 1, 2, 3, 4}), -100), labelling(0, points({0, 1, 2, 3, 5}), -98)}, 1);
  ASSERT_EQ(choices.size(), 1U);
  EXPECT_EQ(choices[0].status, LabelStatus::Ok);
  EXPECT_EQ(choices[0].certain, points({0, 1, 2, 3}));
}

TEST(ChooseDisjoint, IsSureWhenTheOtherIsDecisivelyWorse) {
  const auto choices =
      choose({labelling(0, points({0, 1, 2, 3}), -100), labelling(0, points({1, 0, 3, 2}), -71)}, 1);
  ASSERT_EQ(choices.size(), 1U);
  EXPECT_EQ(choices[0].status, LabelStatus::Ok);
}

TEST(ChooseDisjoint, IsLessSureWhenTheResidualsExceedTheirCovariances) {
  auto best = labelling(0, points({0, 1, 2, 3}), -100);
  best.fit.chi_square = 18;  // three times its degrees of freedom
  const auto choices = choose({best, labelling(0, points({1, 0, 3, 2}), -50)}, 1);
  ASSERT_EQ(choices.size(), 1U);
  EXPECT_EQ(choices[0].status, LabelStatus::Ambiguous);
}

TEST(ChooseDisjoint, CallsABodyAmbiguousThatAnotherCouldReplace) {
  const auto choices =
      choose({labelling(0, points({0, 1, 2, 3}), -100), labelling(1, points({0, 1, 2, 3}), -90)}, 2);
  ASSERT_EQ(choices.size(), 1U);
  EXPECT_EQ(choices[0].labelling, 0U);
  EXPECT_EQ(choices[0].status, LabelStatus::Ambiguous);
}

TEST(ChooseDisjoint, CountsASharedCentreAsASharedPoint) {
  std::vector<Claims> claims(8);
  for (int i = 0; i < 8; ++i) claims[static_cast<std::size_t>(i)] = {i, i};
  claims[7] = {0, 7};  // the same left centre as point 0
  const std::vector<Labelling> labellings = {labelling(0, points({0, 1, 2, 3}), -100),
                                             labelling(1, points({4, 5, 6, 7}), -60)};
  const auto choices = choose_disjoint(labellings, claims, 2, kDecisive, 4);
  ASSERT_EQ(choices.size(), 1U);
  EXPECT_EQ(choices[0].labelling, 0U);
  EXPECT_EQ(choices[0].status, LabelStatus::Ok);
}

TEST(ChooseDisjoint, LeavesOutWhatClutterExplainsBetter) {
  EXPECT_TRUE(choose({labelling(0, points({0, 1, 2, 3}), 3)}, 1).empty());
  EXPECT_TRUE(choose({}, 3).empty());
}

}  // namespace
}  // namespace asterism
