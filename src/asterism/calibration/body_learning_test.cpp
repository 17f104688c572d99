// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "asterism/calibration/body_learning_scene_for_tests.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

using namespace learning;

TEST(LearnBody, FindsCoordinatesNormalsAndDiametersToldOnlyTheNumber) {
  const SeenBody recording = record(12, 1);
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_TRUE(learnt) << learnt.error().what;
  const auto order = match(learnt->body, recording.truth);
  // 0.01 px is 0.015 mm across and 0.03 mm in depth in one frame; twelve frames bring √12.
  EXPECT_LT(distance_rms(learnt->body, recording.truth, order), 0.012);
  std::vector<Vec3> got, is;
  for (std::size_t t = 0; t < 6; ++t) {
    got.push_back(learnt->body.targets[t].position);
    is.push_back(recording.truth.targets[order[t]].position);
  }
  const auto fit = fit_rigid_motion(is, got);
  ASSERT_TRUE(fit);
  for (std::size_t t = 0; t < 6; ++t) {
    const Target& target = learnt->body.targets[t];
    ASSERT_TRUE(target.normal && target.diameter_mm && target.covariance);
    const Vec3 normal = fit->a_from_b.rotation * *target.normal;
    EXPECT_LT(std::acos(normal.dot(*recording.truth.targets[order[t]].normal)), rad_from_deg(1.0));
    EXPECT_NEAR(*target.diameter_mm, 12.0, 0.03);
  }
  EXPECT_EQ(learnt->frames_used, 12);
  EXPECT_EQ(learnt->views_rejected, 0);
  EXPECT_NEAR(learnt->rms_px, 0.01, 0.0015);
  EXPECT_TRUE(learnt->warnings.empty()) << learnt->warnings.front();
}

TEST(LearnBody, PutsItsFrameIntoTheTargetsAndCountsThemCounterClockwiseAsTheCamerasSeeThem) {
  const SeenBody recording = record(8, 2);
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_TRUE(learnt);
  Vec3 sum = Vec3::Zero();
  double last = -1;
  for (const Target& target : learnt->body.targets) {
    sum += target.position;
    const double turn = std::atan2(target.position.y(), target.position.x());
    const double angle = turn < -1e-9 ? turn + 2 * std::numbers::pi : turn;
    EXPECT_GT(angle, last);
    last = angle;
    EXPECT_GT(target.normal->z(), 0.5);  // towards the cameras
  }
  EXPECT_LT(sum.norm(), 1e-9);
  EXPECT_NEAR(learnt->body.targets[0].position.y(), 0, 1e-9);
  EXPECT_GT(learnt->body.targets[0].position.x(), 0);
  EXPECT_EQ(learnt->body.targets[5].id, "T6");
}

TEST(LearnBody, IsNotMisledByHiddenTargetsClutterOrGhosts) {
  SceneOptions scene;
  scene.hidden = 0.15;
  scene.gate_sigmas = 600;  // some ghosts in each frame
  const SeenBody recording = record(20, 3, scene, kTurn_rad, clutter(25, 3));
  std::size_t points = 0;
  for (const ObservedFrame& frame : recording.frames) points += frame.points.size();
  RecordProperty("points", std::to_string(points));
  ASSERT_GT(points, 20U * 40U) << "there should be ghosts";
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_TRUE(learnt) << learnt.error().what;
  EXPECT_LT(distance_rms(learnt->body, recording.truth, match(learnt->body, recording.truth)), 0.012);
  EXPECT_GE(learnt->frames_used, 10);
}

TEST(LearnBody, SeesThroughLensDistortion) {
  SeenBody recording = record(0, 4);
  recording.rig = converging_rig(5);
  for (int f = 0; f < 12; ++f) {
    RandomStream random(4, static_cast<std::uint64_t>(f));
    StereoCentres centres{f, 0, {}, {}};
    add_body(centres, recording.rig, recording.truth, pose_near(random, kTurn_rad), {}, random);
    recording.frames.push_back(observed(std::move(centres), recording.rig));
  }
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_TRUE(learnt) << learnt.error().what;
  EXPECT_LT(distance_rms(learnt->body, recording.truth, match(learnt->body, recording.truth)), 0.012);
}

TEST(LearnBody, TakesFrameAndIdsFromANominalBody) {
  const SeenBody recording = record(10, 5);
  Body nominal = recording.truth;
  RandomStream random(5, 99);
  for (Target& target : nominal.targets)
    target.position += Vec3(random.normal(), random.normal(), random.normal()) * 0.4;
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets(), &nominal);
  ASSERT_TRUE(learnt) << learnt.error().what;
  for (std::size_t t = 0; t < 6; ++t) {
    EXPECT_EQ(learnt->body.targets[t].id, nominal.targets[t].id);
    EXPECT_LT((learnt->body.targets[t].position - nominal.targets[t].position).norm(), 2.0);
    EXPECT_LT((learnt->body.targets[t].position - recording.truth.targets[t].position).norm(), 1.0);
  }
}

TEST(LearnBody, RefusesANominalBodyItIsNot) {
  const SeenBody recording = record(6, 6);
  Body nominal = recording.truth;
  nominal.targets[2].position.x() += 40;
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets(), &nominal);
  ASSERT_FALSE(learnt);
  EXPECT_EQ(learnt.error().reason, BodyLearningFailure::NotTheNominalBody);
}

TEST(LearnBody, StatesDistancesAsWellAsItLearntThem) {
  // Squared error over stated variance, over all pairs and repeats: mean 1. The 15 pairs of a body hang
  // together (12 free numbers), so 40 repeats leave it uncertain by about √(2 / (40 · 12)) = 0.065.
  constexpr int kRepeats = 40;
  std::vector<double> ratio(kRepeats, 0.0);
  SceneOptions scene;
  scene.sigma_px = 0.02;
  scene.hidden = 0.1;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const SeenBody recording = record(8, 100 + static_cast<std::uint64_t>(repeat), scene);
    const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
    ASSERT_TRUE(learnt) << learnt.error().what;
    const auto order = match(learnt->body, recording.truth);
    const auto at = [](std::size_t t) { return static_cast<Eigen::Index>(3 * t); };
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3 apart = learnt->body.targets[i].position - learnt->body.targets[j].position;
        const double is =
            (recording.truth.targets[order[i]].position - recording.truth.targets[order[j]].position).norm();
        const MatX& c = learnt->covariance;
        const Mat3 joint = c.block<3, 3>(at(i), at(i)) + c.block<3, 3>(at(j), at(j)) -
                           c.block<3, 3>(at(i), at(j)) - c.block<3, 3>(at(j), at(i));
        const Vec3 along = apart.normalized();
        ratio[static_cast<std::size_t>(repeat)] +=
            std::pow(apart.norm() - is, 2) / along.dot(joint * along) / 15.0;
      }
    }
  }
  const double mean = std::accumulate(ratio.begin(), ratio.end(), 0.0) / kRepeats;
  // The covariance is never scaled below what the centres state, hence rather small than large.
  EXPECT_GT(mean, 0.75);
  EXPECT_LT(mean, 1.2);
  RecordProperty("mean_ratio", std::to_string(mean));
}

TEST(LearnBody, CarriesTheRigsOwnDoubtIntoTheCoordinates) {
  SeenBody recording = record(8, 7);
  const auto sure = learn_body(recording.rig, recording.frames, "platform", six_targets());
  // The baseline is known to 1 in 10,000 and so are all lengths.
  recording.rig.covariance = MatX::Zero(16, 16);
  const Vec3 baseline = recording.rig.right_from_left.translation;
  recording.rig.covariance.bottomRightCorner<3, 3>() = 1e-8 * baseline * baseline.transpose();
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_TRUE(sure && learnt);
  const auto at = [](std::size_t t) { return static_cast<Eigen::Index>(3 * t); };
  const auto variance = [&](const LearntBody& body) {
    const Vec3 along = (body.body.targets[0].position - body.body.targets[3].position).normalized();
    const MatX& c = body.covariance;
    return along.dot((c.block<3, 3>(at(0), at(0)) + c.block<3, 3>(at(3), at(3)) -
                      c.block<3, 3>(at(0), at(3)) - c.block<3, 3>(at(3), at(0))) *
                     along);
  };
  const double length = (sure->body.targets[0].position - sure->body.targets[3].position).norm();
  EXPECT_NEAR(std::sqrt(variance(*learnt) - variance(*sure)), 1e-4 * length, 0.05e-4 * length);
}

TEST(LearnBody, RefusesAViewThatBelongsToSomethingElse) {
  SeenBody recording = record(10, 8);
  recording.frames[4].centres.left[2].ellipse.centre += Vec2(0.4, 0.3);
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_TRUE(learnt);
  EXPECT_EQ(learnt->views_rejected, 1);
  EXPECT_LT(distance_rms(learnt->body, recording.truth, match(learnt->body, recording.truth)), 0.012);
}

TEST(LearnBody, ComesBackWithoutNormalsWhenTheCentresHaveNoShape) {
  SceneOptions scene;
  scene.shapes = false;
  const SeenBody recording = record(8, 9, scene);
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_TRUE(learnt);
  EXPECT_FALSE(learnt->body.targets[0].normal);
  EXPECT_FALSE(learnt->body.targets[0].diameter_mm);
  EXPECT_NE(learnt->warnings.front().find("no normal"), std::string::npos);
}

TEST(LearnBody, SaysThatNothingMoves) {
  SeenBody recording = record(0, 10);
  for (int f = 0; f < 6; ++f) {
    RandomStream random(10, static_cast<std::uint64_t>(f)), still(10, 1000);
    StereoCentres centres{f, 0, {}, {}};
    add_body(centres, recording.rig, recording.truth, pose_near(still, kTurn_rad), {}, random);
    recording.frames.push_back(observed(std::move(centres), recording.rig));
  }
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_FALSE(learnt);
  EXPECT_EQ(learnt.error().reason, BodyLearningFailure::NothingMoves);
  EXPECT_NE(learnt.error().what.find("nothing moves: 6 points"), std::string::npos) << learnt.error().what;
}

TEST(LearnBody, SaysHowManyTargetsItFoundWhenTheyAreTooFewOrTooMany) {
  const SeenBody recording = record(8, 11);
  BodyLearningOptions options = six_targets();
  options.targets = 8;
  const auto more = learn_body(recording.rig, recording.frames, "platform", options);
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().reason, BodyLearningFailure::TooFewTargets);
  EXPECT_NE(more.error().what.find("only 6 of 8"), std::string::npos) << more.error().what;
  options.targets = 5;
  const auto fewer = learn_body(recording.rig, recording.frames, "platform", options);
  ASSERT_FALSE(fewer);
  EXPECT_EQ(fewer.error().reason, BodyLearningFailure::TooManyTargets);
  EXPECT_NE(fewer.error().what.find("Does the body have 6?"), std::string::npos) << fewer.error().what;
}

TEST(LearnBody, WarnsWhenTheBodyHardlyTurned) {
  const SeenBody recording = record(6, 13, {}, 0.01);
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_TRUE(learnt) << learnt.error().what;
  ASSERT_FALSE(learnt->warnings.empty());
  EXPECT_NE(learnt->warnings.front().find("turned by"), std::string::npos) << learnt->warnings.front();
}

TEST(LearnBody, AsksForTheNumberOfTargetsAndForFrames) {
  const SeenBody recording = record(2, 14);
  BodyLearningOptions untold;
  EXPECT_THROW((void)learn_body(recording.rig, recording.frames, "platform", untold), InputError);
  const auto learnt = learn_body(recording.rig, recording.frames, "platform", six_targets());
  ASSERT_FALSE(learnt);
  EXPECT_EQ(learnt.error().reason, BodyLearningFailure::TooFewFrames);
}

TEST(LearnBody, GivesTheSameBitsOnAnyNumberOfThreads) {
  const SeenBody recording = record(6, 15);
  set_thread_count(1);
  const auto one = learn_body(recording.rig, recording.frames, "platform", six_targets());
  set_thread_count(2);
  const auto two = learn_body(recording.rig, recording.frames, "platform", six_targets());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  for (std::size_t t = 0; t < 6; ++t) EXPECT_EQ(one->body.targets[t].position, two->body.targets[t].position);
}

}  // namespace
}  // namespace asterism
