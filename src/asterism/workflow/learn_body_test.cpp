// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/learn_body.hpp"

#include <gtest/gtest.h>

#include "asterism/calibration/body_learning_scene_for_tests.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

using namespace learning;

Recording recording_of_centres(bool moving) {
  Recording recording;
  recording.folder = "platform_in_motion";
  recording.rig = converging_rig();
  recording.centres.emplace();
  for (int f = 0; f < 8; ++f) {
    RandomStream noise(21, static_cast<std::uint64_t>(f)),
        pose(22, moving ? static_cast<std::uint64_t>(f) : 0);
    StereoCentres centres{f, 0.1 * f, {}, {}};
    add_body(centres, *recording.rig, six_target_body(), pose_near(pose, 0.26), {}, noise);
    recording.frames.push_back({f, 0.1 * f, "", ""});
    recording.centres->push_back(std::move(centres));
  }
  return recording;
}

BodyJobOptions six_targets() {
  BodyJobOptions options;
  options.learning.targets = 6;
  return options;
}

TEST(LearnBodyOf, TakesARecordingOfCentresThroughPointsToABody) {
  const LearntBody learnt =
      learn_body_of(recording_of_centres(true), "platform", six_targets(), nullptr, no_progress);
  EXPECT_EQ(learnt.body.name, "platform");
  EXPECT_EQ(learnt.body.targets.size(), 6U);
  EXPECT_EQ(learnt.frames_used, 8);
  EXPECT_NEAR(learnt.rms_px, 0.01, 0.002);
  EXPECT_NEAR(learnt.ambiguity.four_seen_mm, 14.9, 0.2);
}

TEST(LearnBodyOf, ThrowsTheReasonWhenTheMeasurementDidNotComeOff) {
  try {
    (void)learn_body_of(recording_of_centres(false), "platform", six_targets(), nullptr, no_progress);
    FAIL() << "a body at rest was learnt";
  } catch (const MeasurementError& error) {
    EXPECT_NE(std::string(error.what()).find("nothing moves"), std::string::npos) << error.what();
  }
}

TEST(LearnBodyOf, ThrowsTheNameOfTheKnownBodyRatherThanLearnItUnderAnother) {
  Recording recording = recording_of_centres(true);
  Body scanner = six_target_body();
  scanner.name = "scanner";
  recording.bodies = {scanner};
  try {
    (void)learn_body_of(recording, "platform", six_targets(), nullptr, no_progress);
    FAIL() << "the scanner was learnt as the platform";
  } catch (const MeasurementError& error) {
    EXPECT_NE(std::string(error.what()).find("`scanner`"), std::string::npos) << error.what();
  }
  EXPECT_EQ(learn_body_of(recording, "scanner", six_targets(), nullptr, no_progress).body.name, "scanner");
}

TEST(LearnBodyOf, AsksForARig) {
  Recording recording = recording_of_centres(true);
  recording.rig.reset();
  try {
    (void)learn_body_of(recording, "platform", six_targets(), nullptr, no_progress);
    FAIL() << "a body was learnt without a rig";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("platform_in_motion: no rig"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace asterism
