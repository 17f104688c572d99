// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/simulate_recording.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/files_for_tests.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/io/image_file.hpp"
#include "asterism/io/recording.hpp"
#include "asterism/io/scan_folder.hpp"
#include "asterism/simulation/test_cell.hpp"

namespace asterism {
namespace {

Cell small_cell(int bits) {
  Cell cell = test_cell();
  cell.rig = rig_of({256, 192, 400, 1000, 2300});
  cell.sensor.bits = bits;
  cell.timing = {3, 10};
  return cell;
}

class WrittenImages : public testing::TestWithParam<std::tuple<PictureFormat, int>> {};
INSTANTIATE_TEST_SUITE_P(FormatsAndDepths, WrittenImages,
                         testing::Combine(testing::Values(PictureFormat::Png, PictureFormat::Pgm),
                                          testing::Values(8, 16)));

TEST_P(WrittenImages, AreReadBackBitForBit) {
  const auto [format, bits] = GetParam();
  const TestFolder folder;
  const Cell cell = small_cell(bits);
  SimulateJob job{folder / "recording", {}, format};
  EXPECT_EQ(simulate_recording(cell, job, no_progress).frames, 3U);
  const Recording recording = open_recording(job.out);
  const Simulator simulator(cell, job.options);
  ASSERT_EQ(recording.frames.size(), 3U);
  for (const FrameEntry& entry : recording.frames) {
    const SimulatedFrame made = simulator.frame(entry.frame);
    EXPECT_TRUE(entry.left.ends_with(format == PictureFormat::Pgm ? ".pgm" : ".png"));
    const auto same = [&](const Image& one, const Image& other) {
      return std::visit(
          [](const auto& a, const auto& b) {
            return std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end());
          },
          one, other);
    };
    EXPECT_TRUE(same(read_image(job.out / entry.left), *made.image.left));
    EXPECT_TRUE(same(read_image(job.out / entry.right), *made.image.right));
  }
}

TEST(SimulateRecording, TellsWhatFellOffAndWhatWasKnocked) {
  const TestFolder folder;
  Cell cell = small_cell(8);
  cell.faults = {{FaultKind::FallsOff, "platform", "P1", 0.15, {}},
                 {FaultKind::Knocked, "platform", "P2", 0.05, {0, 1, 0}},
                 {FaultKind::FallsOff, "platform", "P3", 99, {}}};
  SimulateJob job{folder / "recording", {}};
  job.options.level = SimulationLevel::Centres;
  const SimulatedRecording made = simulate_recording(cell, job, no_progress);
  EXPECT_EQ(made.fallen, 1U);  // P3 falls after the last frame, at 0.2 s
  EXPECT_EQ(made.knocked, 1U);
  EXPECT_EQ(made.targets_hidden, 2U);  // P1 in the last frame, in both cameras
  EXPECT_TELLS(folder.read("recording/truth_targets.csv"), "\n2,cam0,platform,P1,");
  // What the tracker is given still has every target where it was learnt.
  const Recording recording = open_recording(job.out);
  EXPECT_EQ(recording.bodies->at(0).targets.at(1).position, cell.movers[0].body.targets[1].position);
}

TEST(SimulateRecording, WritesScansWithTheirTruthPointByPoint) {
  const TestFolder folder;
  Cell cell = small_cell(8);
  const RigidMotion platform = pose_at(cell.movers[0].motion, 0);
  cell.movers[0].motion = at_rest(platform);
  cell.workpiece =
      Solid{"wall", std::make_shared<TriangleMesh>(mesh_of(Box{{500, 500, 20}})), "platform", {}, {}};
  cell.movers.push_back(
      {{"scanner", {{"S1", {0, 0, 0}, {}, {}, {}}}},
       at_rest(platform * RigidMotion{exp_rotation({std::numbers::pi, 0, 0}), {0, 0, 310}})});
  cell.scanner = Scanner{};
  cell.passes = {{3, 0, 0.1}, {1, 0.1, 0.2}};
  SimulateJob job{folder / "recording", {}};
  job.options.level = SimulationLevel::Centres;
  const SimulatedRecording made = simulate_recording(cell, job, no_progress);
  EXPECT_EQ(made.scans, 2U);
  const auto entries = read_scan_entries(job.out);
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].scan, 3);
  std::size_t points = 0;
  for (const ScanEntry& entry : entries) {
    const Scan scan = read_scan(job.out, entry).scan;
    const Cloud truth = read_cloud(job.out / ("truth_" + entry.file));
    ASSERT_EQ(truth.size(), scan.in_scanner.size());
    ASSERT_NE(truth.field("outlier"), nullptr);
    points += truth.size();
    for (const Vec3& point : truth.points) EXPECT_NEAR(point.z(), 10, 1e-3);
  }
  EXPECT_EQ(made.scan_points, points);
  EXPECT_GT(points, 1000U);
  EXPECT_EQ(read_cell(job.out / "cell.toml").passes.size(), 2U);
}

}  // namespace
}  // namespace asterism
