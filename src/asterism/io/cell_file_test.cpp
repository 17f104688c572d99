// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

const std::string kSound = R"(
[tracker]
focal_px = 3000
[[body]]
name = "plate"
motion = {kind = "rest", pose = {position_mm = [0, 0, 2000], yaw_pitch_roll_deg = [90, 0, 0]}}
target = [{id = "A", position_mm = [1, 2, 3], diameter_mm = 10}]
[[obstacle]]
name = "rod"
shape = "capsule"
from_mm = [0, 0, 0]
to_mm = [0, 0, 10]
radius_mm = 2
[light]
glints = 2
)";

std::string complaint(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  const TestFolder folder;
  const std::filesystem::path file = folder.write("cell.toml", text);
  const std::string what = input_error_of([&] { static_cast<void>(read_cell(file)); });
  return what.substr(std::min(file.string().size(), what.size()));
}

TEST(ReadCell, TakesASmallCell) {
  const TestFolder folder;
  const Cell cell = read_cell(folder.write("cell.toml", kSound));
  EXPECT_EQ(cell.rig.left.fx, 3000);
  EXPECT_EQ(cell.light.glints, 2);
  EXPECT_EQ(cell.movers.at(0).body.targets.at(0).id, "A");
  const RigidMotion pose = pose_at(cell.movers[0].motion, 3);
  EXPECT_LT((pose * Vec3(1, 0, 0) - Vec3(0, 1, 2000)).norm(), 1e-9);
}

TEST(ReadCell, SaysWhereAndWhatIsWrong) {
  EXPECT_EQ(complaint(kSound, "focal_px", "focal_mm"),
            ":3: `focal_mm` is no key of [tracker]; did you mean `focal_px`?");
  EXPECT_EQ(complaint(kSound, "glints = 2", "glint = 2"),
            ":15: `glint` is no key of [light]; did you mean `glints`?");
  EXPECT_EQ(complaint(kSound, "glints = 2", "glints = -2"),
            ":15: `glints` is -2; it must lie between 0 and 1000");
  EXPECT_EQ(complaint(kSound, "\"capsule\"", "\"pill\""),
            ":10: `shape` is `pill`; it must be one of: box, capsule, frustum");
  EXPECT_EQ(complaint(kSound, "radius_mm = 2", "radius_mm = \"2\""), ":13: `radius_mm` must be a number");
  EXPECT_EQ(complaint(kSound, "kind = \"rest\", pose", "kind = \"rest\", place"),
            ":6: `place` is no key of a motion; known are: kind, pose");
  EXPECT_EQ(complaint(kSound, "to_mm = [0, 0, 10]\n", ""), ":8: an obstacle has no `to_mm`");
}

TEST(WriteCell, IsReadBackTheSame) {
  const Cell cell = cell_of("engine_casing");
  const TestFolder folder;
  const std::filesystem::path file = folder / "cell.toml";
  write_cell(file, cell);
  const Cell again = read_cell(file);
  EXPECT_EQ(again.name, cell.name);
  EXPECT_EQ(again.sensor.exposure_s, cell.sensor.exposure_s);
  EXPECT_EQ(again.light.vignetting, cell.light.vignetting);
  EXPECT_EQ(again.timing.frames, cell.timing.frames);
  EXPECT_LT(difference(again.rig.right_from_left, cell.rig.right_from_left).norm(), 1e-9);
  ASSERT_EQ(again.movers.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.movers[i].body.targets.size(), cell.movers[i].body.targets.size());
    for (const double t : {0.0, 0.7, 2.9, 5.5}) {
      EXPECT_LT(difference(pose_at(again.movers[i].motion, t), pose_at(cell.movers[i].motion, t)).norm(),
                1e-8);
    }
  }
  ASSERT_EQ(again.obstacles.size(), cell.obstacles.size());
  EXPECT_EQ(again.obstacles[1].level, cell.obstacles[1].level);
  EXPECT_EQ(std::get<Capsule>(again.obstacles[1].shape).radius_mm, 14);
}

TEST(CellOf, NamesTheBuiltInCellsWhenThereIsNoSuchFile) {
  EXPECT_EQ(input_error_of([] { static_cast<void>(cell_of("engin_casing")); }),
            "engin_casing: is neither a file nor a built-in cell; built in are: engine_casing");
}

}  // namespace
}  // namespace asterism
