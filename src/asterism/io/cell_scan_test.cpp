// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_scan.hpp"

#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/io/cell_file.hpp"

namespace asterism {
namespace {

const std::string kCell = R"(
[tracker]
focal_px = 3000
[scanner]
body = "scanner"
[[body]]
name = "scanner"
motion = {kind = "rest", pose = {position_mm = [0, 0, 2000]}}
target = [{id = "A", position_mm = [1, 2, 3], diameter_mm = 10}]
[scan]
share = 0.95
views_each = 2
tolerance_mm = 0.08
floor_mm = -20
[[scan.region]]
name = "flange"
shape = "frustum"
bottom_radius_mm = 500
top_radius_mm = 500
height_mm = 30
pose = {position_mm = [0, 0, 540]}
weight = 3
[robot]
pose = {in = "scanner", position_mm = [1000, 0, 0]}
flange_from_scanner_body = {position_mm = [0, 0, 80]}
[[robot.joint]]
pose = {position_mm = [0, 0, 200]}
lowest_deg = -170
highest_deg = 170
link = {from_mm = [0, 0, 0], to_mm = [0, 0, 300], radius_mm = 80}
[[robot.joint]]
pose = {position_mm = [0, 0, 300], yaw_pitch_roll_deg = [0, 0, 90]}
axis = [0, 2, 0]
link = {from_mm = [0, 0, 0], to_mm = [0, 0, 400], radius_mm = 60}
)";

void expect_the_same(const Cell& cell) {
  const ScanTask& task = cell.scan_task;
  EXPECT_EQ(task.share, 0.95);
  EXPECT_EQ(task.views_each, 2);
  EXPECT_EQ(task.tolerance_mm, 0.08);
  EXPECT_EQ(task.view_s, ScanTask{}.view_s);
  EXPECT_EQ(task.floor_mm, -20);
  ASSERT_EQ(task.regions.size(), 1U);
  EXPECT_EQ(task.regions[0].name, "flange");
  EXPECT_EQ(task.regions[0].weight, 3);
  EXPECT_EQ(std::get<Frustum>(task.regions[0].shape).height_mm, 30);
  EXPECT_NEAR(task.regions[0].workpiece_from_shape.translation.z(), 540, 1e-12);
  ASSERT_TRUE(cell.robot);
  EXPECT_NEAR((cell.robot->tracker_from_base.translation - Vec3(1000, 0, 2000)).norm(), 0, 1e-9);
  EXPECT_NEAR(cell.robot->flange_from_scanner_body.translation.z(), 80, 1e-12);
  ASSERT_EQ(cell.robot->joints.size(), 2U);
  EXPECT_EQ(cell.robot->joints[0].lowest_deg, -170);
  EXPECT_EQ(cell.robot->joints[1].axis, Vec3::UnitY());
  EXPECT_EQ(cell.robot->joints[1].link.radius_mm, 60);
  EXPECT_NEAR(rotation_angle(cell.robot->joints[1].parent_from_joint.rotation, Quaternion::Identity()),
              rad_from_deg(90), 1e-9);
}

TEST(ReadCell, TakesAScanTaskAndARobot) {
  const TestFolder folder;
  expect_the_same(read_cell(folder.write("cell.toml", kCell)));
}

TEST(WriteCell, KeepsAScanTaskAndARobot) {
  const TestFolder folder;
  write_cell(folder / "again.toml", read_cell(folder.write("cell.toml", kCell)));
  expect_the_same(read_cell(folder / "again.toml"));
}

std::string complaint(const std::string& from, const std::string& to) {
  std::string text = kCell;
  text.replace(text.find(from), from.size(), to);
  const TestFolder folder;
  const std::filesystem::path file = folder.write("cell.toml", text);
  const std::string what = input_error_of([&] { static_cast<void>(read_cell(file)); });
  return what.substr(std::min(file.string().size(), what.size()));
}

TEST(ReadCell, SaysWhatIsWrongWithAScanTaskOrARobot) {
  EXPECT_NE(complaint("share = 0.95", "share = 1.5").find("`share` is 1.5"), std::string::npos);
  EXPECT_NE(complaint("views_each", "view_each").find("did you mean `views_each`?"), std::string::npos);
  EXPECT_EQ(complaint("weight = 3", "weight = -1"),
            ": [scan], region `flange`: its weight is -1; it must be 0 or more");
  EXPECT_EQ(complaint("height_mm = 30", "height_mm = 0"),
            ": [scan], region `flange`: its sizes must be positive");
  EXPECT_EQ(complaint("lowest_deg = -170", "lowest_deg = 175"),
            ": [robot], joint 1: `highest_deg` is 170; it must be more than `lowest_deg`, 175");
  EXPECT_NE(complaint("axis = [0, 2, 0]", "axis = [0, 0, 0]").find("`axis` has length zero"),
            std::string::npos);
  EXPECT_EQ(complaint("radius_mm = 60", "radius_mm = 0"),
            ": [robot], joint 2: the radius of its link must be positive");
  EXPECT_EQ(complaint("[scanner]\nbody = \"scanner\"", ""),
            ": [robot]: it carries a scanner, and the cell has no [scanner]");
}

}  // namespace
}  // namespace asterism
