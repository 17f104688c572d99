// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/cell.hpp"
#include "asterism/cell/occluders.hpp"
#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

std::shared_ptr<const TriangleMesh> shared(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

/// A platform that sweeps to the end of its stroke, with a part and a fixture.
Cell sound_cell() {
  Cell cell;
  cell.rig = rig_of({});
  Sweep sweep;
  sweep.tracker_from_rest = {exp_rotation({2, 0, 0}), {0, 0, 2000}};
  sweep.yaw = {rad_from_deg(15), 0.5, 0.3};
  sweep.x = {200, 0.2, 0};
  cell.movers.push_back(
      {{"platform", {{"P1", {0, 0, 600}, {}, {}, {}}, {"P2", {300, 0, 590}, {}, {}, {}}}}, sweep});
  cell.platform = Platform{};
  cell.workpiece = Solid{"casing", shared(mesh_of(CasingShape{})), "platform", {}, {}};
  cell.fixtures.push_back({"clamp", shared(mesh_of(Box{{50, 50, 50}})), "", {}, {}});
  return cell;
}

Sweep& sweep_of(Cell& cell) { return std::get<Sweep>(cell.movers[0].motion); }

std::string complaint(const Cell& cell) {
  return input_error_of([&] { check_cell(cell, "cell.toml"); });
}

TEST(CheckCell, TakesAPlatformAtTheEndOfItsStrokeAndAHollowPart) {
  EXPECT_NO_THROW(check_cell(sound_cell(), "cell.toml"));
}

TEST(CheckCell, SaysWhichAxisGoesBeyondTheStroke) {
  Cell cell = sound_cell();
  sweep_of(cell).pitch = {rad_from_deg(20), 0.25, 0};
  EXPECT_EQ(complaint(cell),
            "cell.toml: body `platform`: goes beyond the platform's stroke: pitch 20.00° at 1.00 s; ±15° is "
            "allowed");
  cell = sound_cell();
  sweep_of(cell).z = {-201, 0.25, 0};
  EXPECT_TELLS(complaint(cell), "z -201.00 mm at 1.00 s; ±200 mm is allowed");
}

TEST(CheckCell, LooksOnlyWhereASweepIsNotAtRest) {
  Cell cell = sound_cell();
  sweep_of(cell).yaw = {};
  sweep_of(cell).x = {};
  sweep_of(cell).pitch = {rad_from_deg(20), 0.25, 0};
  sweep_of(cell).from_s = 2;
  sweep_of(cell).to_s = 4;
  EXPECT_TELLS(complaint(cell), "pitch -20.00° at 3.00 s");
  cell.platform->stroke.pitch_deg = 20;
  EXPECT_NO_THROW(check_cell(cell, "cell.toml"));
}

TEST(CheckCell, SaysWhichAxisIsTooFast) {
  Cell cell = sound_cell();
  cell.platform->stroke.rate_deg_s = 40;  // 15° · 2π · 0.5 Hz = 47.1° a second
  EXPECT_TELLS(complaint(cell), "is faster than the platform: yaw at 47.1°/s at ");
  EXPECT_TELLS(complaint(cell), "; 40°/s is allowed");
  cell = sound_cell();
  cell.platform->stroke.speed_mm_s = 250;  // 200 mm · 2π · 0.2 Hz = 251 mm a second
  EXPECT_TELLS(complaint(cell), "x at 251.3 mm/s at 0.00 s; 250 mm/s is allowed");
}

TEST(CheckCell, LooksAtKeyedMotionFromItsPoseAtTimeZero) {
  Cell cell = sound_cell();
  const RigidMotion rest{exp_rotation({1, 1, 0}), {100, 0, 2200}};
  const RigidMotion rolled =
      rest * rotation_about({0, 0, 600}, rotation_from_yaw_pitch_roll(0, 0, rad_from_deg(13)));
  cell.movers[0].motion = KeyedMotion{{{-1, rest}, {0, rest}, {1, rolled}, {2, rolled}}};
  cell.platform->pivot_mm = {0, 0, 600};
  EXPECT_NO_THROW(check_cell(cell, "cell.toml"));
  // A cubic through two equal keys swings over them.
  cell.platform->stroke.roll_deg = 13;
  EXPECT_TELLS(complaint(cell), "goes beyond the platform's stroke: roll 13.");
  cell.platform->stroke.roll_deg = 15;
  cell.platform->stroke.rate_deg_s = 10;
  EXPECT_TELLS(complaint(cell), "is faster than the platform: roll at 1");
  cell.platform->stroke.rate_deg_s = 100;
  cell.platform->pivot_mm = {0, 0, 600 + 1000};  // then that point goes aside beyond 200 mm
  EXPECT_TELLS(complaint(cell), "goes beyond the platform's stroke: y -20");
}

TEST(CheckCell, RefusesASweepThatJumps) {
  Cell cell = sound_cell();
  sweep_of(cell).from_s = 0.1;
  EXPECT_EQ(
      complaint(cell),
      "cell.toml: body `platform`: its sweep jumps at 0.1 s, where a swing is away from rest; choose the "
      "phase so that it passes through rest there");
  sweep_of(cell).to_s = 0.1;
  EXPECT_TELLS(complaint(cell), "its sweep ends at 0.1 s, not after it begins at 0.1 s");
}

TEST(CheckCell, NamesATargetInsideThePartAndHowDeepItIs) {
  Cell cell = sound_cell();
  cell.movers[0].body.targets[1].position = {453.2 + 0.1208 * 100 - 5, 0, 100};
  // 5 mm along the radius is 4.96 mm across the sloping wall; the polygon takes up to 0.07 mm more.
  EXPECT_EQ(
      complaint(cell),
      "cell.toml: workpiece `casing`: target `P2` of body `platform` is inside it, 5.0 mm deep; a target "
      "must stand on its surface or clear of it");
}

TEST(CheckCell, LetsATargetStandOnThePartOrInItWhenItIsOpenOrElsewhere) {
  Cell cell = sound_cell();
  cell.fixtures[0].body = "platform";
  cell.fixtures[0].carrier_from_solid = {Quaternion::Identity(), {0, 0, 575.05}};
  EXPECT_NO_THROW(check_cell(cell, "cell.toml"));  // P1 lies 0.05 mm below its face
  cell.fixtures[0].carrier_from_solid.translation.z() = 580;
  EXPECT_TELLS(complaint(cell), "fixture `clamp`: target `P1`");
  TriangleMesh open = *cell.fixtures[0].surface;
  open.triangles.pop_back();
  Cell opened = cell;
  opened.fixtures[0].surface = shared(open);
  EXPECT_NO_THROW(check_cell(opened, "cell.toml"));
  cell.fixtures[0].body = "";
  EXPECT_NO_THROW(check_cell(cell, "cell.toml"));
}

TEST(CheckCell, RefusesSolidsThatAreNone) {
  Cell cell = sound_cell();
  cell.workpiece->surface.reset();
  EXPECT_EQ(complaint(cell), "cell.toml: workpiece `casing`: its surface has no triangles");
  cell = sound_cell();
  cell.fixtures[0].surface = shared(mesh_of(Box{{1, 1, 1}}));
  EXPECT_TELLS(complaint(cell), "fixture `clamp`: it is 1.73 mm from corner to corner");
  TriangleMesh broken = mesh_of(Box{{50, 50, 50}});
  broken.vertices[0].x() = std::nan("");
  cell.fixtures[0].surface = shared(broken);
  EXPECT_TELLS(complaint(cell), "a corner of its surface is not a finite number");
}

TEST(CheckCell, SaysWhoIsNotThere) {
  Cell cell = sound_cell();
  cell.platform->body = "plattform";
  EXPECT_EQ(complaint(cell),
            "cell.toml: [platform]: it is body `plattform`, which is not there; bodies are: platform");
  cell = sound_cell();
  cell.workpiece->body = "table";
  EXPECT_TELLS(complaint(cell), "workpiece `casing`: it moves with body `table`, which is not there");
  cell = sound_cell();
  cell.scanner = Scanner{};
  EXPECT_TELLS(complaint(cell), "the scanner: it is carried by body `scanner`, which is not there");
  cell = sound_cell();
  cell.faults.push_back({FaultKind::FallsOff, "platform", "P7", 2, Vec3::Zero()});
  EXPECT_EQ(complaint(cell),
            "cell.toml: the fault at 2 s: body `platform` has no target `P7`; its targets are: P1, P2");
  cell = sound_cell();
  cell.verification.body = "table";
  EXPECT_TELLS(complaint(cell), "[verify]: it is of body `table`, which is not there");
}

TEST(CheckCell, HoldsNewOptionsToTheirLimits) {
  Cell cell = sound_cell();
  cell.noise.sigma_px = -1;
  EXPECT_TELLS(complaint(cell), "`sigma_px` is -1; it must lie between 0 and 1000");
  cell = sound_cell();
  cell.lamps.push_back({"window", {0, std::nan(""), 0}});
  EXPECT_TELLS(complaint(cell), "lamp `window`: its place is not a finite number");
  cell = sound_cell();
  cell.platform->stroke.yaw_deg = 200;
  EXPECT_TELLS(complaint(cell), "`yaw_deg` is 200; it must lie between 0 and 180");
  cell = sound_cell();
  cell.verification.points = {{"rim", {1, 2, 3}}, {"rim", {1, 2, 4}}};
  EXPECT_TELLS(complaint(cell), "point `rim` is given twice");
}

TEST(RemarksOn, TellWhatIsOddAboutASurfaceAndNothingElse) {
  Cell cell = sound_cell();
  EXPECT_TRUE(remarks_on(cell).empty());
  TriangleMesh open = mesh_of(Box{{50, 50, 50}});
  open.triangles.pop_back();
  std::swap(open.triangles[0][1], open.triangles[0][2]);
  open.triangles.push_back({0, 0, 1});
  cell.fixtures[0].surface = shared(open);
  const std::vector<std::string> remarks = remarks_on(cell);
  ASSERT_EQ(remarks.size(), 3U);
  EXPECT_TELLS(remarks[0],
               "`clamp`: the surface is open, edges of one triangle alone: 3; it hides targets as it is");
  EXPECT_TELLS(remarks[1], "`clamp`: triangles face different ways, edges between such: 3;");
  EXPECT_TELLS(remarks[2], "`clamp`: triangles without area: 1; they hide nothing");
}

}  // namespace
}  // namespace asterism
