// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/track_recording.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asterism/camera/disc_image.hpp"
#include "asterism/core/files_for_tests.hpp"
#include "asterism/io/image_file.hpp"
#include "asterism/io/pose_table.hpp"

namespace asterism {
namespace {

const RigidMotion kStart{exp_rotation({0.2, -0.1, 0.3}), {-100, -80, 2000}};

RigidMotion pose_at(int frame) { return {kStart.rotation, kStart.translation + Vec3(2.0 * frame, 0, 0)}; }

/// Exact centres of a body of five targets that moves sideways before two parallel cameras.
Recording recording_of_centres(int frames) {
  Recording recording;
  StereoRig rig;
  rig.left = rig.right = {1600, 1600, 0, 639.5, 479.5, {}, 0, 1280, 960};
  rig.right_from_left.translation = {-500, 0, 0};
  Body body{"part", {}};
  for (const Vec3& place :
       {Vec3(0, 0, 0), Vec3(220, 0, 20), Vec3(0, 300, -40), Vec3(260, 270, 60), Vec3(90, 120, 110)}) {
    body.targets.push_back({"P" + std::to_string(body.targets.size()), place, {}, {}, {}});
  }
  recording.centres.emplace();
  for (int frame = 0; frame < frames; ++frame) {
    StereoCentres centres{frame, 0.1 * frame, {}, {}};
    for (const Side side : {Side::Left, Side::Right}) {
      for (const Target& target : body.targets) {
        Centre centre;
        const Vec3 in_camera = rig.camera_from_tracker(side) * (pose_at(frame) * target.position);
        centre.ellipse = {project(rig.lens(side), in_camera).value().px, 5, 5, 0};
        centre.covariance = 4e-4 * Mat2::Identity();
        (side == Side::Left ? centres.left : centres.right).push_back(centre);
      }
    }
    recording.frames.push_back({frame, centres.time_s, "", ""});
    recording.centres->push_back(centres);
  }
  recording.rig = rig;
  recording.bodies = {{body}};
  return recording;
}

TrackJob job_in(const TestFolder& folder) {
  TrackJob job;
  job.out = folder / "out";
  return job;
}

TEST(TrackRecording, WritesThePosesThatMadeTheCentres) {
  const TestFolder folder;
  TrackJob job = job_in(folder);
  job.covariance = job.tum = true;
  const TrackedRun run = track_recording(recording_of_centres(6), job, no_progress);
  const auto poses = read_poses(folder / "out/poses.csv");
  ASSERT_EQ(poses.size(), 6U);
  for (const PoseRecord& pose : poses) {
    ASSERT_EQ(pose.status, PoseStatus::Ok);
    EXPECT_LT((pose.tracker_from_body->translation - pose_at(pose.frame).translation).norm(), 1e-3);
  }
  const auto summary = nlohmann::json::parse(folder.read("out/summary.json"));
  EXPECT_EQ(summary["bodies"][0]["status"]["OK"], 6);
  EXPECT_EQ(summary["points"], 30);
  EXPECT_TRUE(summary["options"].contains("detection"));
  EXPECT_EQ(read_poses(folder / "out/poses_smoothed.csv").size(), 6U);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/poses.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/part.tum"));
  EXPECT_TRUE(run.warnings.empty());
}

TEST(TrackRecording, NamesATargetThatWasKnockedAndByHowMuch) {
  const TestFolder folder;
  Recording recording = recording_of_centres(12);
  // The file has the target elsewhere than the centres were made with: it moved by (−0.8, 0, 0.6).
  recording.bodies->front().targets[3].position += Vec3(0.8, 0, -0.6);
  const TrackedRun run = track_recording(recording, job_in(folder), no_progress);
  ASSERT_EQ(run.warnings.size(), 1U);
  EXPECT_TELLS(run.warnings[0], "target `P3` of body `part` has moved by 1.00 mm: (-0.8");
  EXPECT_TELLS(run.warnings[0], "left out in 100 % of 12 frames");
  const auto summary = nlohmann::json::parse(folder.read("out/summary.json"));
  const auto& body = summary["bodies"][0];
  EXPECT_EQ(body["rejected"]["P3"], 12);
  EXPECT_EQ(body["knocked"][0]["target"], "P3");
  EXPECT_NEAR(body["knocked"][0]["shift_mm"][2].get<double>(), 0.6, 0.03);  // depth, known to 0.02 mm
  EXPECT_LT(body["detectable_knock_mm"]["P3"].get<double>(), 0.5);
}

TEST(TrackRecording, KeepsWhatWasMeasuredWhenItIsStopped) {
  const TestFolder folder;
  const Progress stop = [](std::string_view, std::size_t done, std::size_t) {
    if (done == 4) throw std::runtime_error("stop");
  };
  EXPECT_THROW(static_cast<void>(track_recording(recording_of_centres(6), job_in(folder), stop)),
               std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/poses.csv"));
  EXPECT_EQ(read_poses(folder / "out/poses.csv.partial").size(), 4U);
}

TEST(TrackRecording, AnUnreadableImageIsALostFrameOfThatCamera) {
  const TestFolder folder;
  Recording recording = recording_of_centres(0);
  recording.centres.reset();
  recording.folder = folder.path();
  write_image(folder / "black.png", Raster8(1280, 960));
  folder.write("cut.png", folder.read("black.png").substr(0, 200));
  recording.frames = {
      {0, 0, "black.png", "black.png"}, {1, 0.1, "cut.png", "black.png"}, {2, 0.2, "black.png", ""}};
  const TrackedRun run = track_recording(recording, job_in(folder), no_progress);
  ASSERT_EQ(run.unreadable.size(), 1U);
  EXPECT_EQ(run.unreadable[0].frame, 1);
  EXPECT_EQ(run.unreadable[0].side, Side::Left);
  EXPECT_EQ(run.frames.size(), 3U);
  EXPECT_EQ(run.frames[1].poses.at(0).status, PoseStatus::Lost);
  recording.frames = {{1, 0.1, "cut.png", "cut.png"}};
  EXPECT_TELLS(
      input_error_of([&] { static_cast<void>(track_recording(recording, job_in(folder), no_progress)); }),
      "none of 2 images could be read");
}

TEST(TrackRecording, SaysWhatIsMissingOrCannotBeTracked) {
  const TestFolder folder;
  const auto fault = [&](const Recording& recording) {
    return input_error_of(
        [&] { static_cast<void>(track_recording(recording, job_in(folder), no_progress)); });
  };
  Recording recording = recording_of_centres(1);
  recording.bodies.reset();
  EXPECT_TELLS(fault(recording), "has no bodies.toml; name one with --bodies");
  recording.rig.reset();
  EXPECT_TELLS(fault(recording), "has no rig.yaml; name one with --rig");
  recording = recording_of_centres(1);
  auto& targets = recording.bodies->front().targets;
  targets.resize(4);
  for (std::size_t i = 0; i < targets.size(); ++i)
    targets[i].position = Vec3(100, 50, 20) * static_cast<double>(i * i);
  EXPECT_TELLS(fault(recording), "body `part`: its targets lie on one line");
  targets.resize(2);
  EXPECT_TELLS(fault(recording), "body `part` has 2 targets");
}

}  // namespace
}  // namespace asterism
