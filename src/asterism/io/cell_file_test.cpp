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

TEST(CellOf, BringsALayoutTaskForThePlatform) {
  const Cell cell = cell_of("engine_casing");
  ASSERT_TRUE(cell.volume && cell.layout);
  EXPECT_EQ(cell.layout->body, "platform");
  EXPECT_EQ(cell.layout->points.size(), 8U);
  const auto& room = std::get<CylinderRoom>(cell.layout->surface.patches.at(0).patch);
  EXPECT_EQ(room.radius_mm, 350);
  EXPECT_EQ(room.base_mm.z(), 580);
}

TEST(CellOf, HasAWorkingVolumeThatBothCamerasSee) {
  const Cell cell = cell_of("engine_casing");
  const RigidMotion tracker_from_middle_ = tracker_from_middle(cell.rig);
  const WorkingVolume& volume = cell.volume.value();
  for (const double sx : {-0.5, 0.5}) {
    for (const double sy : {-0.5, 0.5}) {
      for (const bool far : {false, true}) {
        const Vec3 corner = {sx * (far ? volume.far_width_mm : volume.near_width_mm),
                             sy * (far ? volume.far_height_mm : volume.near_height_mm),
                             far ? volume.far_mm : volume.near_mm};
        for (const Side side : {Side::Left, Side::Right}) {
          const auto image = project(cell.rig.lens(side),
                                     cell.rig.camera_from_tracker(side) * (tracker_from_middle_ * corner));
          ASSERT_TRUE(image.has_value());
          EXPECT_GT(image->px.minCoeff(), 0);
          EXPECT_LT(image->px.x(), cell.rig.lens(side).width_px - 1);
          EXPECT_LT(image->px.y(), cell.rig.lens(side).height_px - 1);
        }
      }
    }
  }
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

const std::string kWhole = R"(
[tracker]
focal_px = 3000
[[body]]
name = "table"
motion = {kind = "sweep", pose = {position_mm = [0, 0, 2000]}, roll = {amplitude_deg = 10, frequency_hz = 1}, order = "roll-pitch-yaw", from_s = 1, to_s = 2}
target = [{id = "A", position_mm = [0, 0, 200]}, {id = "B", position_mm = [100, 0, 200]}]
[[body]]
name = "gun"
motion = {kind = "rest", pose = {position_mm = [0, 500, 1500]}}
published = {layout = "Table 1 S2", tilt_deg = 10, diameter_mm = 8}
[platform]
body = "table"
pivot_mm = [0, 0, 50]
stroke = {roll_deg = 10, rate_deg_s = 90}
read_out = {rate_hz = 50, latency_s = 0.02}
[workpiece]
name = "wedge"
mesh = "wedge.off"
unit = "cm"
pose = {position_mm = [0, 0, 20]}
level = 0.1
[[fixture]]
name = "pin"
shape = "capsule"
from_mm = [0, 0, 0]
to_mm = [0, 0, 50]
radius_mm = 5
body = "table"
pose = {position_mm = [50, 0, 0]}
[[fixture]]
name = "shroud"
casing = {bottom_radius_mm = 100, top_radius_mm = 90, height_mm = 80, bosses = 0}
[scanner]
body = "gun"
stand_off_mm = 250
pose = {position_mm = [0, 0, -80], yaw_pitch_roll_deg = [0, 0, 180]}
[noise]
sigma_px = 0.2
[[fault]]
kind = "knocked"
body = "table"
target = "A"
time_s = 3
shift_mm = [1, 0, 0]
[[fault]]
kind = "falls-off"
body = "gun"
target = "P3"
[[lamp]]
name = "window"
position_mm = [0, -1000, 4000]
radius_mm = 200
level = 3
[verify]
tolerance_mm = 0.5
[[verify.point]]
name = "tip"
position_mm = [0, 0, 120]
[sensor]
focus_mm = 2000
aperture_mm = 6
[light]
specular = 0.5
)";
const std::string kWedge = "OFF 4 4 0\n0 0 0\n10 0 0\n0 10 0\n0 0 10\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

void expect_whole(const Cell& cell) {
  ASSERT_TRUE(cell.platform && cell.workpiece && cell.scanner);
  EXPECT_EQ(cell.platform->body, "table");
  EXPECT_EQ(cell.platform->pivot_mm.z(), 50);
  EXPECT_EQ(cell.platform->stroke.rate_deg_s, 90);
  EXPECT_EQ(cell.platform->read_out.latency_s, 0.02);
  EXPECT_EQ(cell.workpiece->name, "wedge");
  EXPECT_EQ(cell.workpiece->body, "table");
  EXPECT_EQ(cell.workpiece->level, 0.1);
  EXPECT_EQ(cell.workpiece->carrier_from_solid.translation.z(), 20);
  EXPECT_EQ(facts_of(*cell.workpiece->surface).highest, Vec3(100, 100, 100));
  ASSERT_EQ(cell.fixtures.size(), 2U);
  EXPECT_EQ(cell.fixtures[0].body, "table");
  EXPECT_EQ(cell.fixtures[0].carrier_from_solid.translation.x(), 50);
  EXPECT_EQ(cell.fixtures[1].body, "");
  EXPECT_TRUE(facts_of(*cell.fixtures[1].surface).closed());
  EXPECT_EQ(cell.scanner->stand_off_mm, 250);
  EXPECT_LT((cell.scanner->body_from_scanner * Vec3(0, 0, 250) - Vec3(0, 0, -330)).norm(), 1e-12);
  EXPECT_EQ(cell.noise.sigma_px, 0.2);
  ASSERT_EQ(cell.faults.size(), 2U);
  EXPECT_EQ(cell.faults[0].kind, FaultKind::Knocked);
  EXPECT_EQ(cell.faults[0].shift_mm, Vec3(1, 0, 0));
  EXPECT_EQ(cell.faults[1].target, "P3");
  ASSERT_EQ(cell.lamps.size(), 1U);
  EXPECT_EQ(cell.lamps[0].radius_mm, 200);
  EXPECT_EQ(cell.lamps[0].in_tracker_mm, Vec3(0, -1000, 4000));
  EXPECT_EQ(cell.verification.tolerance_mm, 0.5);
  EXPECT_EQ(cell.verification.points.at(0).name, "tip");
  EXPECT_EQ(cell.sensor.focus_mm, 2000);
  EXPECT_EQ(cell.light.specular, 0.5);
  EXPECT_EQ(cell.movers[1].body.targets.at(5).position, Vec3(-240, -200, 610));
  const auto& sweep = std::get<Sweep>(cell.movers[0].motion);
  EXPECT_EQ(sweep.order, TurnOrder::RollPitchYaw);
  EXPECT_EQ(sweep.to_s, 2);
}

TEST(ReadCell, TakesPlatformPartFixturesScannerAndWhatGoesWrong) {
  const TestFolder folder;
  folder.write("wedge.off", kWedge);
  expect_whole(read_cell(folder.write("cell.toml", kWhole)));
}

TEST(WriteCell, KeepsThemAllAndTheSurfacesToTheBit) {
  const TestFolder folder;
  folder.write("wedge.off", kWedge);
  const Cell cell = read_cell(folder.write("cell.toml", kWhole));
  write_cell(folder / "there/again.toml", cell);
  EXPECT_TRUE(std::filesystem::exists(folder / "there/again.workpiece.ply"));
  const Cell again = read_cell(folder / "there/again.toml");
  expect_whole(again);
  EXPECT_EQ(again.workpiece->surface->vertices, cell.workpiece->surface->vertices);
  EXPECT_EQ(again.workpiece->surface->triangles, cell.workpiece->surface->triangles);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.fixtures[i].surface->vertices, cell.fixtures[i].surface->vertices);
    EXPECT_EQ(again.fixtures[i].surface->triangles, cell.fixtures[i].surface->triangles);
  }
}

std::string whole_complaint(const std::string& from, const std::string& to) {
  std::string text = kWhole;
  EXPECT_NE(text.find(from), std::string::npos) << from;
  text.replace(text.find(from), from.size(), to);
  const TestFolder folder;
  folder.write("wedge.off", kWedge);
  const std::filesystem::path file = folder.write("cell.toml", text);
  std::string what = input_error_of([&] { static_cast<void>(read_cell(file)); });
  const std::string beside = folder.path().string() + "/";
  for (auto at = what.find(beside); at != std::string::npos; at = what.find(beside))
    what.erase(at, beside.size());
  return what;
}

TEST(ReadCell, SaysWhatIsWrongWithAPart) {
  EXPECT_EQ(whole_complaint("unit = \"cm\"", "unit = \"km\""),
            "cell.toml:20: `unit` is `km`; it must be one of: mm, cm, m, inch");
  EXPECT_EQ(whole_complaint("unit = \"cm\"", "unit = \"m\"\nflip = true"),
            "cell.toml:19: wedge.off: the mesh is inside out when flipped; leave `flip` out");
  EXPECT_TELLS(whole_complaint("unit = \"cm\"\n", ""),
               "cell.toml:19: wedge.off: a mesh file does not tell its unit");
  EXPECT_EQ(
      whole_complaint("wedge.off", "wegde.off"),
      "cell.toml:19: mesh `wegde.off` is not there; it is sought beside the cell and in ASTERISM_DATA_PATH");
  EXPECT_TELLS(whole_complaint("wedge.off", "turbine_.off"), "mesh `turbine_.off` is not there");
  EXPECT_EQ(whole_complaint("mesh = \"wedge.off\"\nunit = \"cm\"\n", ""),
            "cell.toml:17: [workpiece] needs a surface: `mesh`, a file, or [workpiece.casing]");
  EXPECT_EQ(whole_complaint("level = 0.1", "levels = 0.1"),
            "cell.toml:22: `levels` is no key of [workpiece]; did you mean `level`?");
  EXPECT_EQ(whole_complaint("shape = \"capsule\"\n", ""),
            "cell.toml:23: a fixture needs a surface: `mesh`, a file, [fixture.casing], or a `shape` as in "
            "[[obstacle]]");
  EXPECT_EQ(whole_complaint("bosses = 0", "wall_mm = 95"),
            "cell.toml:33: `wall_mm` is 95; it must be less than the smaller radius");
}

TEST(ReadCell, SaysWhatIsWrongWithPlatformAndFaults) {
  EXPECT_EQ(
      whole_complaint("roll_deg = 10,", "roll_deg = 9,"),
      "cell.toml: body `table`: goes beyond the platform's stroke: roll 10.00° at 1.25 s; ±9° is allowed");
  EXPECT_EQ(whole_complaint("rate_deg_s", "rate_degs"),
            "cell.toml:15: `rate_degs` is no key of [platform.stroke]; did you mean `rate_deg_s`?");
  EXPECT_EQ(whole_complaint("target = \"A\"", "target = \"Z\""),
            "cell.toml: the fault at 3 s: body `table` has no target `Z`; its targets are: A, B");
  EXPECT_EQ(whole_complaint("shift_mm = [1, 0, 0]\n", ""),
            "cell.toml:40: a knocked target needs its `shift_mm`");
  EXPECT_EQ(whole_complaint("\"knocked\"", "\"kicked\""),
            "cell.toml:41: `kind` is `kicked`; it must be one of: falls-off, knocked");
  EXPECT_EQ(
      whole_complaint("Table 1 S2", "Table 2 S2"),
      "cell.toml:11: `layout` is `Table 2 S2`; it must be one of: Table 1 S1, Table 1 S2, Table 1 S3, Table "
      "9 S1, Table 9 S2, Table 9 S3, Table 9 S4, Table 9 S5");
}

TEST(CellOf, HasAHollowPartOnAPlatformAndAScanner) {
  for (const std::string name : {"engine_casing", "paper_cell"}) {
    const Cell cell = cell_of(name);
    ASSERT_TRUE(cell.platform && cell.workpiece) << name;
    EXPECT_EQ(cell.workpiece->body, "platform");
    EXPECT_TRUE(facts_of(*cell.workpiece->surface).closed());
    EXPECT_TRUE(remarks_on(cell).empty());
    EXPECT_EQ(cell.movers[0].body.targets.at(3).position, Vec3(0, -250, 605));
  }
  EXPECT_TRUE(cell_of("engine_casing").scanner);
}

TEST(CellOf, MovesThePapersPlatformAsItsFigure20) {
  const Cell cell = cell_of("paper_cell");
  const Motion& motion = cell.movers[0].motion;
  const RigidMotion rest = pose_at(motion, 0);
  EXPECT_LT(difference(pose_at(motion, 4.9), rest).norm(), 1e-12);
  EXPECT_LT(difference(pose_at(motion, 9.1), rest).norm(), 1e-12);
  for (const double tau : {0.3, 1.7, 3.2}) {
    const double x = rad_from_deg(15) * std::sin(2 * std::numbers::pi * 0.5 * tau);
    const double y = rad_from_deg(15) * std::sin(2 * std::numbers::pi * 0.25 * tau);
    const Quaternion turn = exp_rotation({x, 0, 0}) * exp_rotation({0, y, 0});
    EXPECT_LT(rotation_angle(rest.rotation.conjugate() * pose_at(motion, 5 + tau).rotation, turn), 1e-9)
        << tau;
  }
  EXPECT_EQ(cell.noise.sigma_px, 0.2);
  EXPECT_EQ(cell.timing.frames, 601);
}

TEST(CellOf, NamesTheBuiltInCellsWhenThereIsNoSuchFile) {
  EXPECT_EQ(input_error_of([] { static_cast<void>(cell_of("engin_casing")); }),
            "engin_casing: is neither a file nor a built-in cell; built in are: engine_casing, paper_cell");
}

}  // namespace
}  // namespace asterism
