// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/probed_points.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

const RigidMotion kTrackerFromPlatform{exp_rotation({0, 0, 0.5}), {100, -20, 2000}};

std::string poses_at_frame_7() {
  const auto& [q, t] = kTrackerFromPlatform;
  return fmt::format(
      "frame,body,x_mm,y_mm,z_mm,qw,qx,qy,qz\n7,platform,{},{},{},{:.15g},{:.15g},{:.15g},{:.15g}\n", t.x(),
      t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
}

TEST(ReadProbed, CarriesPointsOfTheTrackersFrameToThePlatformWithItsDoubt) {
  const TestFolder folder;
  const Vec3 in_platform(300, 0, 50), in_tracker = kTrackerFromPlatform * in_platform;
  ProbedFile file;
  file.points = folder.write(
      "probed.csv", fmt::format("name,frame,x_mm,y_mm,z_mm,sigma_mm\nA,7,{:.12g},{:.12g},{:.12g},0.01\n",
                                in_tracker.x(), in_tracker.y(), in_tracker.z()));
  file.poses = folder.write("poses.csv", poses_at_frame_7());
  file.stated = {0.02, 0.01};
  const auto points = read_probed(file);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_LT((points[0].in_platform - in_platform).norm(), 1e-8);
  // Along x: both places. Along y, 300 mm and 50 mm from the axes that turn it: the lever arm too.
  const double place = 0.01 * 0.01 + 0.02 * 0.02, turn = rad_from_deg(0.01);
  EXPECT_NEAR(points[0].covariance(0, 0), place + turn * turn * 50 * 50, 1e-12);
  EXPECT_NEAR(points[0].covariance(1, 1), place + turn * turn * (300 * 300 + 50 * 50), 1e-12);
}

TEST(ReadProbed, SaysInWhichLineThePlatformWasNotMeasured) {
  const TestFolder folder;
  ProbedFile file;
  file.points = folder.write("probed.csv", "name,frame,x_mm,y_mm,z_mm\nA,7,1,2,3\nB,8,1,2,3\n");
  file.poses = folder.write("poses.csv", poses_at_frame_7());
  const std::string message = input_error_of([&] { return read_probed(file).size(); });
  EXPECT_TELLS(message, "probed.csv:3");
  EXPECT_TELLS(message, "`platform` was not measured in it");
  file.points = folder.write("bare.csv", "name,x_mm,y_mm,z_mm\nA,1,2,3\n");
  EXPECT_TELLS(input_error_of([&] { return read_probed(file).size(); }), "frame");
}

}  // namespace
}  // namespace asterism
