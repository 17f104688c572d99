// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_known.hpp"

#include <gtest/gtest.h>

#include "asterism/calibration/body_learning_scene_for_tests.hpp"

namespace asterism {
namespace {

using namespace learning;

Body six_target_probe() {
  Body probe{"probe", {}};
  for (const Vec3& p : {Vec3(0, 0, 600), Vec3(70, 10, 600), Vec3(20, 90, 610), Vec3(-60, 30, 590),
                        Vec3(-30, -80, 605), Vec3(55, -60, 598)}) {
    probe.targets.push_back({std::to_string(probe.targets.size()), p, Vec3::UnitZ(), 8.0, std::nullopt});
  }
  return probe;
}

/// Both bodies move, each its own way; of the platform the share told is hidden.
SeenBody record_two(std::uint64_t seed, const Body& probe, double hidden) {
  SeenBody recording;
  SceneOptions scene;
  scene.hidden = hidden;
  for (int f = 0; f < 8; ++f) {
    RandomStream random(seed, static_cast<std::uint64_t>(f));
    StereoCentres centres{f, 0.1 * f, {}, {}};
    add_body(centres, recording.rig, recording.truth, pose_near(random, kTurn_rad), scene, random);
    add_body(centres, recording.rig, probe, pose_near(random, kTurn_rad, Vec3(100, 100, 1900)), {}, random);
    recording.frames.push_back(observed(std::move(centres), recording.rig));
  }
  return recording;
}

TEST(LearnBody, TellsTwoMovingBodiesApartByTheirNumberOfTargetsOrSaysThatItCannot) {
  SeenBody recording = record(0, 12);
  const Body probe = six_target_probe();
  Body small = probe;
  small.targets.pop_back();
  for (const Body& other : {probe, small}) {
    recording.frames.clear();
    for (int f = 0; f < 8; ++f) {
      RandomStream random(12, static_cast<std::uint64_t>(f));
      StereoCentres centres{f, 0, {}, {}};
      add_body(centres, recording.rig, recording.truth, pose_near(random, kTurn_rad), {}, random);
      add_body(centres, recording.rig, other, pose_near(random, kTurn_rad, Vec3(100, 100, 1900)), {}, random);
      recording.frames.push_back(observed(std::move(centres), recording.rig));
    }
    const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
    if (other.targets.size() == 6) {
      ASSERT_FALSE(learnt);
      EXPECT_EQ(learnt.error().reason, BodyLearningFailure::SeveralBodies) << learnt.error().what;
      const auto meant = learn_body(recording.rig, recording.frames, "probe", six_targets(), &probe);
      ASSERT_TRUE(meant) << meant.error().what;
      EXPECT_LT((meant->body.targets[1].position - probe.targets[1].position).norm(), 0.1);
      const auto rest =
          learn_body(recording.rig, recording.frames, "platform", six_targets(), nullptr, {&probe, 1});
      ASSERT_TRUE(rest) << rest.error().what;
      EXPECT_LT(distance_rms(rest->body, recording.truth, match(rest->body, recording.truth)), 0.02);
    } else {
      ASSERT_TRUE(learnt) << learnt.error().what;
      EXPECT_LT(distance_rms(learnt->body, recording.truth, match(learnt->body, recording.truth)), 0.02);
      ASSERT_FALSE(learnt->warnings.empty());
      EXPECT_NE(learnt->warnings.front().find("passed over"), std::string::npos) << learnt->warnings.front();
    }
  }
}

TEST(LearnBody, RefusesTheKnownBodyByNameWhenNothingElseIsLeft) {
  const Body probe = six_target_probe();
  const SeenBody recording = record_two(31, probe, 0.95);
  const auto learnt =
      learn_body(recording.rig, recording.frames, "platform", six_targets(), nullptr, {&probe, 1});
  ASSERT_FALSE(learnt) << "the probe was learnt as the platform";
  EXPECT_EQ(learnt.error().reason, BodyLearningFailure::KnownBody) << learnt.error().what;
  EXPECT_NE(learnt.error().what.find("what moves is `probe`, known already; `platform` was not found"),
            std::string::npos)
      << learnt.error().what;
}

TEST(LearnBody, LearnsAKnownBodyThatIsTheNominalOne) {
  const Body probe = six_target_probe();
  const SeenBody recording = record_two(31, probe, 0.95);
  const auto learnt =
      learn_body(recording.rig, recording.frames, "handle", six_targets(), &probe, {&probe, 1});
  ASSERT_TRUE(learnt) << learnt.error().what;
  EXPECT_EQ(learnt->body.name, "handle");
}

/// The first targets of a body as a set that moved.
RigidSet set_of(const Body& body, std::size_t count) {
  RigidSet set;
  const RigidMotion set_from_body{exp_rotation({0.3, -0.5, 1.2}), Vec3(40, 500, -120)};
  for (std::size_t t = 0; t < count; ++t)
    set.targets.push_back({set_from_body * body.targets[t].position, 0.01 * Mat3::Identity()});
  return set;
}

TEST(UnknownSets, PassesOverABodySeenInPartOnly) {
  const Body probe = six_target_probe(), platform = six_target_body();
  const auto sets =
      unknown_sets({set_of(probe, 4), set_of(platform, 6)}, "platform", nullptr, {&probe, 1}, 3.0);
  ASSERT_TRUE(sets) << sets.error().what;
  ASSERT_EQ(sets->size(), 1U);
  EXPECT_EQ(sets->front().targets.size(), 6U);
}

TEST(UnknownSets, IsEmptyWhereNothingMoves) {
  const Body probe = six_target_probe();
  const auto sets = unknown_sets({}, "platform", nullptr, {&probe, 1}, 3.0);
  ASSERT_TRUE(sets);
  EXPECT_TRUE(sets->empty());
}

TEST(MistakenForKnown, NamesTheBodyThatMostTargetsBelongTo) {
  const Body probe = six_target_probe();
  RigidSet set = set_of(probe, 5);
  set.targets.push_back({Vec3(0, 0, 0), 0.01 * Mat3::Identity()});  // a stray point
  const auto mistaken = mistaken_for_known(set, "platform", nullptr, {&probe, 1}, 3.0);
  ASSERT_TRUE(mistaken);
  EXPECT_NE(mistaken->what.find("`probe` (5 of 6 points lie as its targets do)"), std::string::npos)
      << mistaken->what;
  EXPECT_FALSE(mistaken_for_known(set_of(six_target_body(), 6), "platform", nullptr, {&probe, 1}, 3.0));
}

}  // namespace
}  // namespace asterism
