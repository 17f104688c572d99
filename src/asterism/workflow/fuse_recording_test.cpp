// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/fuse_recording.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/pose_table.hpp"
#include "asterism/io/reading_table.hpp"

namespace asterism {
namespace {

constexpr double kLatency_s = 0.04;
const Mat6 kNoise = Vec6(1e-8, 1e-8, 1e-8, 1e-3, 1e-3, 1e-3).asDiagonal();

/// A body that swings, or not, seen for 4 s but for half a second.
RigidMotion swinging(double time_s, double swing_rad) {
  return {exp_rotation({0.1, swing_rad * std::sin(2 * time_s), 0.3}),
          {300 * swing_rad * std::cos(3 * time_s), -80, 2000}};
}

Vec6 noise(std::uint64_t index, std::uint32_t purpose) {
  RandomStream random(1, index, purpose);
  Vec6 six;
  for (Eigen::Index i = 0; i < 6; ++i) six(i) = std::sqrt(kNoise(i, i)) * random.normal();
  return six;
}

TrackedRun run_of(double swing_rad) {
  TrackedRun run;
  run.bodies = {{"part", {}}, {"table", {}}};
  for (int i = 0; i < 80; ++i) {
    TrackedFrame frame;
    frame.centres = {100 + i, 0.05 * i, {}, {}};
    const RigidMotion truth = swinging(0.05 * i, swing_rad);
    const PoseEstimate estimate{perturbed(truth, noise(static_cast<std::uint64_t>(i), 1)), kNoise,
                                Mat6::Zero()};
    const bool seen = i < 40 || i >= 50;
    frame.poses = {BodyPose{}, {1, seen ? PoseStatus::Ok : PoseStatus::Lost, {}, 6, 0.01}};
    if (seen) frame.poses[1].estimate = estimate;
    run.frames.push_back(frame);
  }
  return run;
}

FuseRequest request_in(const TestFolder& folder, double swing_rad) {
  const RigidMotion base_from_tracker{exp_rotation({0, 1, 0}), {0, 50, -1800}};
  std::vector<PlatformReading> readings;
  for (int i = 0; i < 400; ++i) {
    const RigidMotion truth = base_from_tracker * swinging(0.01 * i - kLatency_s, swing_rad);
    readings.push_back(
        {0.01 * i, perturbed(truth, noise(static_cast<std::uint64_t>(i), 2)), kNoise, Mat6::Zero()});
  }
  write_readings(folder / "read_out.csv", readings);
  return {folder / "read_out.csv", "table", {}, 0};
}

TEST(FuseRecording, TellsTheLatencyAndWritesThePosesItCarried) {
  const TestFolder folder;
  const TrackedRun run = run_of(0.2);
  const FuseJob job = fuse_job_of(request_in(folder, 0.2), run.bodies);
  const FusedRecording fusion = fuse_recording(run, job, {}, folder.path());
  ASSERT_TRUE(fusion.offset);
  EXPECT_NEAR(fusion.latency_s, kLatency_s, 4 * fusion.latency_sigma_s);
  EXPECT_LT(fusion.latency_sigma_s, 1e-3);
  const auto poses = read_poses(folder / "poses_fused.csv");
  ASSERT_EQ(poses.size(), 80U);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].frame, 100 + static_cast<int>(i));
    EXPECT_EQ(poses[i].body, "table");
    EXPECT_EQ(poses[i].status, i < 40 || i >= 50 ? PoseStatus::Ok : PoseStatus::Predicted);
    const Vec6 error = difference(*poses[i].tracker_from_body, swinging(0.05 * static_cast<double>(i), 0.2));
    EXPECT_LT(error.tail<3>().norm(), 0.3) << i;  // one reading alone: 0.05 mm, and 10 ms until the frame
  }
  const auto told = nlohmann::json::parse(folder.read("fusion.json"));
  EXPECT_EQ(told["status"]["PREDICTED"], 10);
  EXPECT_EQ(told["latency_told_from_run"], true);
}

TEST(FuseRecording, AtRestAsksForTheLatencyAndThenUsesTheReadings) {
  const TestFolder folder;
  const TrackedRun run = run_of(0);
  FuseJob job = fuse_job_of(request_in(folder, 0), run.bodies);
  try {
    static_cast<void>(fuse_recording(run, job, {}, folder.path()));
    FAIL();
  } catch (const MeasurementError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("the platform does not move enough while both speak for its "
                        "latency to be told; where it is known, give it with "
                        "--read-out-latency"),
              std::string::npos)
        << error.what();
  }
  job.latency_s = kLatency_s;
  const FusedRecording fusion = fuse_recording(run, job, {}, folder.path());
  EXPECT_FALSE(fusion.offset);
  EXPECT_EQ(fusion.poses[45].status, PoseStatus::Predicted);
}

TEST(FuseRecording, NamesTheNearestBody) {
  const TestFolder folder;
  FuseRequest request = request_in(folder, 0.2);
  request.body = "tabel";
  try {
    static_cast<void>(fuse_job_of(request, run_of(0.2).bodies));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("`tabel` is no body of the recording; did you mean `table`?"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace asterism
