// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "asterism/cell/cell.hpp"
#include "asterism/cell/occluders.hpp"
#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

Cell sound_cell() {
  Cell cell;
  cell.rig = rig_of({});
  cell.movers.push_back({{"scanner", {{"S1", {0, 0, 600}, {}, {}, {}}}}, at_rest({})});
  cell.workpiece = Solid{"box", std::make_shared<TriangleMesh>(mesh_of(Box{{90, 90, 90}})), "", {}, {}};
  cell.scanner = Scanner{};
  cell.passes = {{2, 1, 3}, {1, 3, 4}};
  return cell;
}

std::string complaint(const Cell& cell) {
  return input_error_of([&] { check_cell(cell, "cell.toml"); });
}

TEST(CheckScanner, TakesASoundScannerAndPassesInAnyOrder) {
  EXPECT_NO_THROW(check_cell(sound_cell(), "cell.toml"));
}

TEST(CheckScanner, DistancesAndAnglesAreInOrder) {
  Cell cell = sound_cell();
  cell.scanner->far_mm = 150;
  EXPECT_EQ(complaint(cell), "cell.toml: [scanner]: `near_mm` is 200; it must be less than `far_mm`, 150");
  cell = sound_cell();
  cell.scanner->stand_off_mm = 500;
  EXPECT_TELLS(complaint(cell),
               "`stand_off_mm` is 500; it must lie between `near_mm`, 200, and `far_mm`, 400");
  cell = sound_cell();
  cell.scanner->good_incidence_deg = 70;
  EXPECT_TELLS(complaint(cell),
               "`good_incidence_deg` is 70; it must not be more than `max_incidence_deg`, 60");
  cell = sound_cell();
  cell.scanner->body = "gun";
  EXPECT_TELLS(complaint(cell), "it is carried by body `gun`, which is not there");
}

TEST(CheckScanner, SaysWhichPassIsWrong) {
  Cell cell = sound_cell();
  cell.passes[0].to_s = 1;
  EXPECT_EQ(complaint(cell), "cell.toml: scan pass 2: it ends at 1 s, not after it begins at 1 s");
  cell = sound_cell();
  cell.passes[0].to_s = std::numeric_limits<double>::infinity();
  EXPECT_TELLS(complaint(cell), "its times must be finite numbers");
  cell = sound_cell();
  cell.passes[1].scan = 2;
  EXPECT_TELLS(complaint(cell), "scan pass 2: its number is given twice");
  cell = sound_cell();
  cell.passes[1].scan = -1;
  EXPECT_TELLS(complaint(cell), "its number is negative");
  cell = sound_cell();
  cell.passes[1].from_s = 2.5;
  EXPECT_TELLS(complaint(cell), "scan pass 1: it begins at 2.5 s, while pass 2 lasts until 3 s");
  cell = sound_cell();
  cell.workpiece.reset();
  EXPECT_TELLS(complaint(cell), "scan pass 2: there is no [workpiece]");
  cell.scanner.reset();
  EXPECT_TELLS(complaint(cell), "scan pass 2: there is no [scanner]");
}

}  // namespace
}  // namespace asterism
