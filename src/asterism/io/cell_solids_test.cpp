// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

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
[[scan_pass]]
scan = 4
from_s = 0.5
to_s = 2
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
  ASSERT_EQ(cell.passes.size(), 1U);
  EXPECT_EQ(cell.passes[0].scan, 4);
  EXPECT_EQ(cell.passes[0].from_s, 0.5);
  EXPECT_EQ(cell.passes[0].to_s, 2);
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
  EXPECT_TELLS(whole_complaint("scan = 4\n", ""), "a scan pass has no `scan`");
  EXPECT_TELLS(whole_complaint("from_s = 0.5", "from_s = 2"), "scan pass 4: it ends at 2 s");
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

TEST(ReadCell, TakesThePoseOfWhatIsCarriedInItsCarriersFrameOnly) {
  EXPECT_EQ(whole_complaint("pose = {position_mm = [50, 0, 0]}",
                            "pose = {in = \"table\", position_mm = [50, 0, 0]}"),
            "cell.toml:30: `in` is no key of a pose in a body; known are: position_mm, yaw_pitch_roll_deg, "
            "quaternion_wxyz");
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

}  // namespace
}  // namespace asterism
