// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/fuse_scans.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/random.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/io/pose_table.hpp"
#include "asterism/io/scan_folder.hpp"

namespace asterism {
namespace {

constexpr double kRadius_mm = 80, kNoise_mm = 0.05;

/// A ball seen from five sides, in frames whose origin is the ball's own middle, as published range images
/// often are: `mm_each` mm is the unit of its numbers.
void write_ball(const TestFolder& folder, double mm_each, bool times = true) {
  std::string poses =
      times ? "frame,time_s,body,x_mm,y_mm,z_mm,qw,qx,qy,qz\n" : "frame,body,x_mm,y_mm,z_mm,qw,qx,qy,qz\n";
  std::string scans = times ? "scan,file,time_s,body\n" : "scan,file,body\n";
  for (int number = 0; number < 5; ++number) {
    const RigidMotion ball_from_scan = {exp_rotation({0, 1.2 * number, 0}), {3.0 * number, -2, 1}};
    Scan scan;
    scan.number = number;
    RandomStream random(3, static_cast<std::uint64_t>(number));
    for (int i = 0; i < 3000; ++i) {
      const double x = random.uniform(-60, 60), y = random.uniform(-60, 60);
      if (x * x + y * y > 70 * 70) continue;
      const Vec3 on_ball(x, y, std::sqrt(kRadius_mm * kRadius_mm - x * x - y * y));
      const Vec3 seen = on_ball * (1 + kNoise_mm / kRadius_mm * random.normal());
      // The frame of the scan: the ball's middle lies at −R⁻¹ t in it.
      scan.in_scanner.push_back(((ball_from_scan.rotation.conjugate() *
                                  (ball_from_scan.rotation * seen - ball_from_scan.translation)) /
                                 mm_each)
                                    .cast<float>());
    }
    write_scan(folder.path(), scan);
    scans += times ? fmt::format("{},scans/{:03}.ply,{},scanner\n", number, number, number)
                   : fmt::format("{},scans/{:03}.ply,scanner\n", number, number);
    const Quaternion& q = ball_from_scan.rotation;
    const Vec3& t = ball_from_scan.translation;
    poses += times ? fmt::format("{},{},scanner,{},{},{},{},{},{},{}\n", number, number, t.x(), t.y(), t.z(),
                                 q.w(), q.x(), q.y(), q.z())
                   : fmt::format("{},scanner,{},{},{},{},{},{},{}\n", number, t.x(), t.y(), t.z(), q.w(),
                                 q.x(), q.y(), q.z());
  }
  folder.write("scans.csv", scans);
  folder.write("poses.csv", poses);
}

FuseScansJob job_of(const TestFolder& folder, double mm_each) {
  FuseScansJob job;
  job.scans = {folder.path()};
  job.out = folder / "out" / "cloud.ply";
  job.scans_mm_each = mm_each;
  job.options.fusion.voxel_mm = 4;
  return job;
}

void expect_ball(const FusedScans& fused) {
  ASSERT_GT(fused.cloud.size(), 1000u);
  double square = 0;
  std::size_t inwards = 0;
  for (std::size_t i = 0; i < fused.cloud.size(); ++i) {
    square +=
        std::pow(fused.cloud.points[i].norm() - kRadius_mm, 2) / static_cast<double>(fused.cloud.size());
    inwards += fused.cloud.normals[i].cast<double>().dot(fused.cloud.points[i]) < 0 ? 1 : 0;
  }
  EXPECT_LT(std::sqrt(square), 2 * kNoise_mm);
  EXPECT_EQ(inwards, 0u);
  EXPECT_EQ(fused.frame, "tracker");
}

TEST(FuseScans, TakesABareFolderInMetresWithAPoseAScan) {
  const TestFolder folder;
  write_ball(folder, 1000);
  const FusedScans fused = fuse_scans(job_of(folder, 1000), no_progress);
  expect_ball(fused);
  // The noise is what the scans tell: theirs, and what the ball bends between points 2 mm apart.
  EXPECT_GT(fused.scanner.depth_sigma_mm, 0.5 * kNoise_mm);
  EXPECT_LT(fused.scanner.depth_sigma_mm, 4 * kNoise_mm);
  EXPECT_EQ(read_cloud(folder / "out" / "cloud.ply").size(), fused.cloud.size());
  const auto json = nlohmann::json::parse(folder.read("out/fusion.json"));
  EXPECT_EQ(json.at("points"), fused.cloud.size());
  EXPECT_EQ(json.at("scans").size(), 5u);
}

TEST(FuseScans, TakesFrameNumbersWhereNoTimesAreTold) {
  const TestFolder folder;
  write_ball(folder, 1, false);
  expect_ball(fuse_scans(job_of(folder, 1), no_progress));
}

TEST(FuseScans, LeavesOutAScanWithoutAPoseAndSaysSo) {
  const TestFolder folder;
  write_ball(folder, 1);
  const std::string scans = folder.read("scans.csv");
  folder.write("scans.csv", scans.substr(0, scans.rfind("4,scans")) + "4,scans/004.ply,7.5,scanner\n");
  const FusedScans fused = fuse_scans(job_of(folder, 1), no_progress);
  EXPECT_EQ(fused.scans[4].used, 0u);
  EXPECT_EQ(fused.scans[4].outside_run + fused.scans[4].outliers, fused.scans[4].points);
  bool said = false;
  for (const std::string& remark : fused.remarks)
    said = said || remark.find("1 scans are left out") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(FuseScans, PutsTwoRunsInOneCloudAndKeepsTheirNumbersApart) {
  const TestFolder folder;
  write_ball(folder, 1);
  FuseScansJob job = job_of(folder, 1);
  const FusedScans once = fuse_scans(job, no_progress);
  job.scans.push_back(folder.path());
  const FusedScans twice = fuse_scans(job, no_progress);
  expect_ball(twice);
  ASSERT_EQ(twice.scans.size(), 10u);
  EXPECT_EQ(twice.scans[4].scan, 4);
  EXPECT_EQ(twice.scans[5].scan, 5);
  EXPECT_EQ(twice.fused.points_in, 2 * once.fused.points_in);
  EXPECT_TRUE(std::any_of(twice.remarks.begin(), twice.remarks.end(), [](const std::string& remark) {
    return remark.find("have numbers that are taken") != std::string::npos;
  }));
}

TEST(FuseScans, TellsWhatIsWrong) {
  const TestFolder folder;
  write_ball(folder, 1);
  FuseScansJob job = job_of(folder, 1);
  job.reference = "turntable";
  EXPECT_TELLS(input_error_of([&] { return fuse_scans(job, no_progress).scans.size(); }),
               "no pose of the reference body `turntable`; there are: scanner");
  Scan small;
  for (int i = 0; i < 100; ++i)
    small.in_scanner.emplace_back(0.001F * static_cast<float>(i % 10), 0.001F * static_cast<float>(i), 0.3F);
  write_scan(folder.path(), small);
  job = job_of(folder, 1);
  EXPECT_TELLS(input_error_of([&] { return fuse_scans(job, no_progress).scans.size(); }),
               "it must be in another unit");
  std::filesystem::remove(folder / "poses.csv");
  EXPECT_TELLS(input_error_of([&] { return fuse_scans(job, no_progress).scans.size(); }),
               "there are no poses");
  job.scans = {folder / "nowhere"};
  EXPECT_TELLS(input_error_of([&] { return fuse_scans(job, no_progress).scans.size(); }), "is no folder");
}

}  // namespace
}  // namespace asterism
