// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "asterism/core/result.hpp"
#include "asterism/tracking/identification_scene_for_tests.hpp"

namespace asterism {
namespace {

using namespace identification_scene;

TEST(Identify, GivesTheLayoutsMarginForTheTargetsSeen) {
  Seen seen;
  seen.add(0, kNearlyTurned, kThere, all_targets(kNearlyTurned));
  const auto found = identify(seen, {kNearlyTurned});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_NEAR(found[0].margin_mm, 14.2, 0.05) << "the margin of S1 with all targets seen";
}

TEST(Identify, CallsALayoutThatFitsItselfTurnedAmbiguousWhateverTheNoiseFavours) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    Seen seen;
    seen.random = RandomStream(12, trial);
    seen.add(0, kSymmetric, kThere, all_targets(kSymmetric));
    seen.add_ghosts(10);
    const auto found = identify(seen, {kSymmetric});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].status, LabelStatus::Ambiguous);
    EXPECT_LT(found[0].margin_mm, 0.01);
  }
}

TEST(Identify, CallsAPartlyHiddenLayoutAmbiguousWhenWhatIsLeftIsNearlySymmetric) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    Seen seen;
    seen.random = RandomStream(13, trial);
    seen.add(0, kNearlyTurned, kThere, {0, 1, 2, 3});
    const auto found = identify(seen, {kNearlyTurned});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].status, LabelStatus::Ambiguous);
    EXPECT_NEAR(found[0].margin_mm, 0.198, 0.15) << "less what the noise gives to the rival";
  }
}

TEST(Identify, SettlesAnAmbiguityByAPriorThatIsNear) {
  Seen seen;
  seen.add(0, kSymmetric, kThere, all_targets(kSymmetric));
  Vec6 moved;
  moved << 0.02, -0.01, 0.03, 2, -3, 1;
  const auto prior = prior_at(perturbed(kThere, moved), 0.03, 5);
  const auto found = identify(seen, {kSymmetric}, {prior});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_TRUE(all_right(found[0], seen));
}

TEST(Identify, LeavesAnAmbiguityToAPriorThatIsFarOrVague) {
  Seen seen;
  seen.add(0, kSymmetric, kThere, all_targets(kSymmetric));
  const auto vague = prior_at(kThere, 2.0, 500);
  const RigidMotion turned = kThere * RigidMotion{exp_rotation(Vec3(0, 0, 1.4)), Vec3::Zero()};
  for (const auto& prior : {vague, prior_at(turned, 0.03, 5)}) {
    const auto found = identify(seen, {kSymmetric}, {prior});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].status, LabelStatus::Ambiguous);
  }
}

TEST(Identify, TakesThreeTargetsOnlyWithAPriorNear) {
  Seen seen;
  seen.add(0, kPlatform, kThere, {0, 1, 3});
  seen.add_ghosts(30);
  EXPECT_TRUE(identify(seen, {kPlatform}).empty());
  EXPECT_TRUE(identify(seen, {kPlatform}, {prior_at(kElsewhere, 0.03, 5)}).empty());
  const auto found = identify(seen, {kPlatform}, {prior_at(kThere, 0.03, 5)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_EQ(found[0].points.size(), 3U);
  EXPECT_TRUE(all_right(found[0], seen));
}

TEST(Identify, CannotTellWhichOfTwinsItSees) {
  Body twin = kPlatform;
  twin.name = "twin";
  Seen one;
  one.add(0, kPlatform, kThere, all_targets(kPlatform));
  const auto single = identify(one, {kPlatform, twin});
  ASSERT_EQ(single.size(), 1U) << "points are given to one body only";
  EXPECT_EQ(single[0].status, LabelStatus::Ambiguous);
  EXPECT_LT(single[0].margin_mm, 1e-6);

  one.add(1, twin, kElsewhere, all_targets(twin));
  const auto both = identify(one, {kPlatform, twin});
  ASSERT_EQ(both.size(), 2U);
  for (const auto& labels : both) EXPECT_EQ(labels.status, LabelStatus::Ambiguous);

  const auto settled =
      identify(one, {kPlatform, twin}, {prior_at(kThere, 0.03, 5), prior_at(kElsewhere, 0.03, 5)});
  ASSERT_EQ(settled.size(), 2U);
  for (const auto& labels : settled) {
    EXPECT_EQ(labels.status, LabelStatus::Ok);
    EXPECT_TRUE(all_right(labels, one));
  }
}

TEST(Identify, CallsABodySeenTwiceAmbiguous) {
  Seen seen;
  seen.add(0, kPlatform, kThere, all_targets(kPlatform));
  seen.add(0, kPlatform, kElsewhere, all_targets(kPlatform));
  const auto found = identify(seen, {kPlatform});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ambiguous);
}

TEST(Identify, LeavesOutATargetThatTwoPointsContest) {
  Seen seen;
  seen.add(0, kPlatform, kThere, all_targets(kPlatform));
  seen.add(kThere * kPlatform.targets[2].position + Vec3(0.2, 0.1, -0.1));
  const auto found = identify(seen, {kPlatform});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_EQ(found[0].points.size(), 5U);
  EXPECT_TRUE(all_right(found[0], seen));
  for (const auto& label : found[0].points) EXPECT_NE(label.target, 2);
}

TEST(BodyCatalogue, CountsOtherBodiesInTheMargin) {
  Body near_twin = kProbe;
  near_twin.name = "near twin";
  near_twin.targets[3].position.z() += 3;
  const double alone = BodyCatalogue({kProbe}).margin_mm(0, {0, 1, 2, 3, 4});
  const double beside = BodyCatalogue({kProbe, near_twin}).margin_mm(0, {0, 1, 2, 3, 4});
  EXPECT_GT(alone, 5);
  EXPECT_LT(beside, 1.35) << "3 mm on one of five points: 3/√5 before the fit";
  EXPECT_GT(beside, 0.5);
}

TEST(Identify, StaysAmbiguousWhenTheRivalIsAsNearThePrior) {
  const Body close_pair =
      body_of("close pair", {{0, 0, 0}, {100, 0, 0}, {0, 80, 0}, {30, 20, 60}, {30.3, 20, 60}});
  Seen seen;
  seen.add(0, close_pair, kThere, all_targets(close_pair));
  const auto found = identify(seen, {close_pair}, {prior_at(kThere, 0.001, 0.1)});
  ASSERT_EQ(found.size(), 1U);
  for (const auto& label : found[0].points) {
    EXPECT_TRUE(found[0].status == LabelStatus::Ambiguous || label.target < 3)
        << "which of the two cannot be told";
  }
}

}  // namespace
}  // namespace asterism
