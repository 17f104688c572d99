// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

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

const std::string kWithTask = R"(
[tracker.volume]
preset = "9.1 m3"
[[body]]
name = "plate"
motion = {kind = "rest", pose = {position_mm = [0, 0, 2000]}}
target = [{id = "A", position_mm = [1, 2, 3]}]
[layout]
body = "plate"
most = 8
spacing_mm = 40
[[layout.patch]]
name = "side"
kind = "cylinder-side"
radius_mm = 300
height_mm = 50
from_deg = -90
to_deg = 90
[[layout.patch]]
name = "ring"
kind = "annulus"
centre_mm = [0, 0, 50]
inner_radius_mm = 100
outer_radius_mm = 300
[[layout.patch]]
name = "flap"
kind = "plate"
pose = {position_mm = [0, 0, 90], yaw_pitch_roll_deg = [90, 0, 0]}
width_mm = 80
height_mm = 60
[[layout.patch]]
name = "room"
kind = "cylinder-room"
base_mm = [0, 0, 580]
radius_mm = 350
height_mm = 40
tilt_deg = 20
[[layout.keep_out]]
name = "eye"
shape = "capsule"
pose = {position_mm = [10, 0, 0]}
from_mm = [0, 0, 0]
to_mm = [0, 0, 100]
radius_mm = 30
[[layout.point]]
name = "rim"
position_mm = [200, 0, 900]
)";

TEST(ReadCell, TakesAWorkingVolumeAndALayoutTask) {
  const TestFolder folder;
  const Cell cell = read_cell(folder.write("cell.toml", kWithTask));
  EXPECT_NEAR(volume_m3(cell.volume.value()), 9.1, 1e-9);
  const LayoutTask& task = cell.layout.value();
  EXPECT_EQ(task.body, "plate");
  EXPECT_EQ(task.most, 8);
  EXPECT_EQ(task.spacing_mm, 40);
  ASSERT_EQ(task.surface.patches.size(), 4U);
  const auto& side = std::get<CylinderSide>(task.surface.patches[0].patch);
  EXPECT_NEAR(side.from_rad, -0.5 * std::numbers::pi, 1e-12);
  EXPECT_EQ(side.height_mm, 50);
  EXPECT_NEAR(std::get<Annulus>(task.surface.patches[1].patch).to_rad, 2 * std::numbers::pi, 1e-12);
  const auto& plate = std::get<Plate>(task.surface.patches[2].patch);
  EXPECT_LT((plate.body_from_plate * Vec3(1, 0, 0) - Vec3(0, 1, 90)).norm(), 1e-12);
  EXPECT_NEAR(std::get<CylinderRoom>(task.surface.patches[3].patch).tilt_rad, rad_from_deg(20), 1e-12);
  EXPECT_EQ(task.surface.keep_outs.at(0).name, "eye");
  EXPECT_EQ(task.surface.keep_outs[0].body_from_shape.translation.x(), 10);
  EXPECT_EQ(task.points.at(0).in_body_mm, Vec3(200, 0, 900));
}

TEST(ReadCell, SaysWhatIsWrongWithAVolumeOrATask) {
  EXPECT_EQ(complaint(kWithTask, "preset = \"9.1 m3\"", "near_m = 3"),
            ":3: `near_m` is no key of [tracker.volume]; did you mean `near_mm`?");
  EXPECT_EQ(complaint(kWithTask, "preset = \"9.1 m3\"", "preset = \"9 m3\""),
            ":3: `preset` is `9 m3`; it must be one of: 9.1 m3, 16.6 m3");
  EXPECT_EQ(complaint(kWithTask, "spacing_mm = 40", "spacing = 40"),
            ":11: `spacing` is no key of [layout]; did you mean `spacing_mm`?");
  EXPECT_EQ(complaint(kWithTask, "[[layout.patch]]", "[[layout.patches]]"),
            ":12: `patches` is no key of [layout]; did you mean `patch`?");
  EXPECT_EQ(complaint(kWithTask, "\"annulus\"", "\"ring\""),
            ":21: `kind` is `ring`; it must be one of: cylinder-side, annulus, plate, cylinder-room");
  EXPECT_EQ(complaint(kWithTask, "from_deg", "start_deg"),
            ":17: `start_deg` is no key of a cylinder-side; did you mean `to_deg`?");
  EXPECT_EQ(complaint(kWithTask, "most = 8", "most = 80"), ":10: `most` is 80; it must lie between 4 and 64");
  EXPECT_EQ(complaint(kWithTask, "body = \"plate\"\nmost", "body = \"plane\"\nmost"),
            ": the layout task is for body `plane`, which is not there; bodies are: plate");
}

TEST(WriteCell, KeepsAWorkingVolumeAndALayoutTask) {
  const TestFolder folder;
  const Cell cell = read_cell(folder.write("cell.toml", kWithTask));
  const std::filesystem::path file = folder / "again.toml";
  write_cell(file, cell);
  const Cell again = read_cell(file);
  EXPECT_NEAR(volume_m3(again.volume.value()), 9.1, 1e-9);
  ASSERT_EQ(again.layout->surface.patches.size(), 4U);
  EXPECT_NEAR(std::get<CylinderSide>(again.layout->surface.patches[0].patch).to_rad, 0.5 * std::numbers::pi,
              1e-12);
  EXPECT_EQ(std::get<Capsule>(again.layout->surface.keep_outs.at(0).shape).radius_mm, 30);
  EXPECT_EQ(again.layout->points.at(0).name, "rim");
  EXPECT_EQ(again.layout->spacing_mm, 40);
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
  EXPECT_EQ(again.obstacles[0].level, cell.obstacles[0].level);
  EXPECT_EQ(std::get<Capsule>(again.obstacles[0].shape).radius_mm, 14);
}

}  // namespace
}  // namespace asterism
