// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/io/centre_table.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/label_table.hpp"
#include "asterism/io/point_table.hpp"
#include "asterism/io/pose_table.hpp"

namespace asterism {
namespace {

template <class Reader>
std::string fault_of(const Reader& reader, const std::string& text) {
  const TestFolder folder;
  const auto file = folder.write("t.csv", text);
  return input_error_of([&] { static_cast<void>(reader(file)); });
}

TEST(CsvTable, ReadsQuotesEmptyCellsAndBothLineEnds) {
  const TestFolder folder;
  const CsvTable table(folder.write("t.csv", "\xEF\xBB\xBFname, x \r\n\"a, \"\"b\"\"\",1\r\n\nc,\n"), {"x"});
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.text(0, "name"), "a, \"b\"");
  EXPECT_EQ(table.number(0, "x"), 1);
  EXPECT_FALSE(table.optional_number(1, "x"));
  EXPECT_EQ(table.place(1), (folder / "t.csv").string() + ":4");
  EXPECT_EQ(csv_cell("a, \"b\""), "\"a, \"\"b\"\"\"");
}

TEST(CsvTable, TellsLineAndColumnOfWhatIsWrong) {
  const auto read = [](const auto& file) { return CsvTable(file, {"x_px"}); };
  EXPECT_TELLS(fault_of(read, "x_pix,y\n1,2\n"), "t.csv:1: column `x_px` is missing (is it `x_pix`?)");
  EXPECT_TELLS(fault_of(read, "x_px,y\n1\n"), "t.csv:2: has 1 cells where the header has 2");
  EXPECT_TELLS(fault_of(read, "x_px,x_px\n"), "column `x_px` is given twice");
  EXPECT_TELLS(fault_of(read, "x_px\n\"open\n"), "t.csv:2: a quote is opened and never closed");
  EXPECT_TELLS(fault_of(read, ""), "t.csv:1: column `x_px` is missing");
}

TEST(ReadCentreRows, NeedsOnlyTheTwoCoordinates) {
  const TestFolder folder;
  const auto rows = read_centre_rows(folder.write("t.csv", "x_px,y_px\n1.5,2\n3,4\n"));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].frame, 0);
  EXPECT_EQ(rows[1].index, 1);
  EXPECT_FALSE(rows[1].camera);
  EXPECT_EQ(rows[0].centre.px(), Vec2(1.5, 2));
  EXPECT_EQ(rows[0].centre.covariance, Mat2(kUnstatedSigmaPx * kUnstatedSigmaPx * Mat2::Identity()));
}

TEST(ReadCentreRows, WhatIsWrittenComesBackAsStereoFrames) {
  const TestFolder folder;
  StereoCentres centres{3, 0, {}, {}};
  for (int i = 0; i < 3; ++i) {
    Centre centre;
    centre.ellipse = {Vec2(100.5 + i, 200.25), 6, 4, 0.5};
    centre.covariance << 1e-4, 2e-5, 2e-5, 4e-4;
    centre.amplitude = -180;
    centre.flags = kOccluded | kBorder;
    (i < 2 ? centres.left : centres.right).push_back(centre);
  }
  CentreTable table(folder / "t.csv");
  table.write(centres, "left/a.png", "right/a.png");
  table.finish();
  const auto frames = stereo_centres(read_centre_rows(folder / "t.csv"), "t.csv");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].frame, 3);
  ASSERT_EQ(frames[0].left.size(), 2U);
  const Centre& back = frames[0].left[1];
  EXPECT_EQ(back.px(), Vec2(101.5, 200.25));
  EXPECT_NEAR(back.ellipse.angle_rad, 0.5, 1e-5);
  EXPECT_LT((back.covariance - centres.left[1].covariance).norm(), 1e-8);
  EXPECT_EQ(back.flags, kOccluded | kBorder);
  EXPECT_EQ(back.amplitude, -180);
}

TEST(ReadCentreRows, TellsWhatIsWrong) {
  EXPECT_TELLS(fault_of(read_centre_rows, "x_px,y_px\n1,nan\n"),
               "t.csv:2: column `y_px`: `nan` is no finite number");
  EXPECT_TELLS(fault_of(read_centre_rows, "camera,x_px,y_px\nmiddle,1,2\n"),
               "`middle` must be left or right");
  EXPECT_TELLS(fault_of(read_centre_rows, "x_px,y_px,sigma_x_px\n1,2,0\n"),
               "column `sigma_x_px`: must be positive");
  EXPECT_TELLS(fault_of(read_centre_rows, "x_px,y_px,flags\n1,2,ocluded\n"), "did you mean `occluded`?");
  CentreRow row;
  row.camera = Side::Left;
  row.index = 1;
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(stereo_centres({row}, "t.csv")); }),
               "centre 0 of the left camera is missing");
  EXPECT_TELLS(input_error_of([&] {
                 static_cast<void>(stereo_centres({row, row}, "t.csv"));
               }),
               "is given twice");
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(rows_of_camera({row}, Side::Right, "t.csv")); }),
               "holds no centres of the right camera");
}

TEST(ReadPoints, WhatIsWrittenComesBackAndNotStatedCovarianceIsZero) {
  const TestFolder folder;
  Point point;
  point.in_tracker = {1.25, -2.5, 2300};
  point.covariance << 4, 1, 0, 1, 3, 0.5, 0, 0.5, 9;
  point.epipolar_error_px = -0.25;
  point.left = 4;
  PointTable table(folder / "t.csv");
  table.write(7, {point, point});
  table.finish();
  const auto frames = read_points(folder / "t.csv");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].frame, 7);
  ASSERT_EQ(frames[0].points.size(), 2U);
  EXPECT_EQ(frames[0].points[1].in_tracker, point.in_tracker);
  EXPECT_EQ(frames[0].points[1].covariance, point.covariance);
  EXPECT_EQ(frames[0].points[1].left, 4);
  EXPECT_EQ(frames[0].points[1].right, -1);
  const auto bare = read_points(folder.write("b.csv", "frame,point,x_mm,y_mm,z_mm\n0,0,1,2,3\n"));
  EXPECT_EQ(bare[0].points[0].covariance, Mat3(Mat3::Zero()));
  EXPECT_TELLS(fault_of(read_points, "frame,point,x_mm,y_mm,z_mm\n0,1,1,2,3\n"),
               "frame 0: point 0 is missing");
}

TEST(LabelTable, GivesEachPointARow) {
  const TestFolder folder;
  LabelTable table(folder / "t.csv",
                   {{"platform", {{"P1", {0, 0, 0}, {}, {}, {}}, {"P2", {1, 0, 0}, {}, {}, {}}}}});
  table.write(2, 3, {{0, LabelStatus::Ambiguous, {{1, 1}}, {}, 0.1, 0.25}});
  table.finish();
  EXPECT_EQ(folder.read("t.csv"),
            "frame,point,body,target,status,margin_mm\n2,0,,,,\n2,1,platform,P2,AMBIGUOUS,0.2500\n2,2,,,,\n");
  EXPECT_EQ(read_labels(folder / "t.csv").at(1).status, LabelStatus::Ambiguous);
}

PoseRecord sample_pose() {
  PoseRecord pose{
      5,  0.25, "platform", PoseStatus::Partial, RigidMotion{exp_rotation({0.1, 2, 0.3}), {1, 2, 2500}},
      {}, 3,    0.02};
  Mat6 covariance = Mat6::Identity() * 1e-4;
  covariance(0, 4) = covariance(4, 0) = 3e-5;
  pose.covariance = covariance;
  pose.systematic = 0.25 * covariance;
  return pose;
}

TEST(ReadPoses, WhatIsWrittenComesBackAndAnUntrustedPoseIsNotShown) {
  const TestFolder folder;
  const PoseRecord pose = sample_pose();
  PoseTable table(folder / "t.csv");
  table.write(pose);
  table.write({6, 0.5, "platform", PoseStatus::Lost, {}, {}, 0, 0});
  table.finish();
  folder.write("p.json", json_line(pose) + "\n");
  auto read = read_poses(folder / "t.csv");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].status, PoseStatus::Partial);
  EXPECT_LT(difference(*read[0].tracker_from_body, *pose.tracker_from_body).norm(), 1e-9);
  EXPECT_NEAR((*read[0].covariance)(5, 5), 1e-4, 1e-9);
  EXPECT_EQ((*read[0].covariance)(0, 4), 0);
  EXPECT_EQ(read[1].status, PoseStatus::Lost);
  EXPECT_FALSE(read[1].tracker_from_body);
  read_pose_covariances(folder / "p.json", read);
  EXPECT_EQ(*read[0].covariance, *pose.covariance);
  EXPECT_EQ(*read[0].systematic, *pose.systematic);
}

TEST(ReadPoses, TellsWhatIsWrong) {
  const std::string head = "frame,body,x_mm,y_mm,z_mm,qw,qx,qy,qz\n";
  EXPECT_TELLS(fault_of(read_poses, head + "0,a,1,2,3,1,1,0,0\n"),
               "t.csv:2: column `qw`: qw to qz have length 1.41421");
  EXPECT_TELLS(fault_of(read_poses, head + "0,a,1,2,3,1,0,0,0\n0,a,1,2,3,1,0,0,0\n"),
               "frame 0 of body `a` is given twice");
  EXPECT_TELLS(fault_of(read_poses, "frame,x_mm,y_mm,z_mm,qw,qx,qy,qz\n"), "column `body` is missing");
  const TestFolder folder;
  std::vector<PoseRecord> poses = {sample_pose()};
  const auto file = folder.write("p.json", "{}\n");
  EXPECT_TELLS(input_error_of([&] { read_pose_covariances(file, poses); }), "p.json:1: is no JSON object");
}

TEST(WriteTum, GivesSecondsAndMetres) {
  const TestFolder folder;
  PoseRecord pose = sample_pose();
  pose.tracker_from_body->rotation = Quaternion::Identity();
  write_tum(folder / "t.tum", {pose}, "platform");
  EXPECT_EQ(folder.read("t.tum"),
            "0.250000000 0.001000000 0.002000000 2.500000000 0.000000000000 0.000000000000 0.000000000000 "
            "1.000000000000\n");
}

}  // namespace
}  // namespace asterism
