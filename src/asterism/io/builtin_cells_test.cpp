// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_file.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

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

TEST(CellOf, TakesTheTurbineOrSaysHowToGetIt) {
  const auto meshes =
      std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "data/meshes";
  if (!std::filesystem::exists(meshes / "turbine.off")) {
    EXPECT_EQ(input_error_of([] { static_cast<void>(cell_of("turbine_casing")); }),
              "turbine_casing:38: mesh `turbine.off` is not there; it is of Debian's libcgal-demo, and "
              "`tools/setup "
              "test` fetches it");
    GTEST_SKIP() << "turbine.off is not there";
  }
  const Cell cell = cell_of("turbine_casing");
  const MeshFacts facts = facts_of(*cell.workpiece->surface);
  EXPECT_TRUE(facts.closed());
  EXPECT_NEAR((facts.highest - facts.lowest).maxCoeff(), 1200, 1e-9);
  EXPECT_TRUE(remarks_on(cell).empty());
  // It stands on the table, and the targets beside it.
  const MeshFacts placed = facts_of(moved(*cell.workpiece->surface, cell.workpiece->carrier_from_solid));
  EXPECT_NEAR(placed.lowest.z(), 0, 0.1);
  for (const Target& target : cell.movers[0].body.targets) EXPECT_GT(target.position.head<2>().norm(), 610);
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
            "engin_casing: is neither a file nor a built-in cell; built in are: engine_casing, paper_cell, "
            "turbine_casing");
}

}  // namespace
}  // namespace asterism
