// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/frame_chain.hpp"

#include <gtest/gtest.h>

#include "asterism/cell/paper_layouts.hpp"

namespace asterism {
namespace {

/// A platform that sweeps, a part on it and a scanner that passes by; all seen from `elsewhere`.
Cell cell_seen_from(const RigidMotion& elsewhere) {
  Cell cell;
  Sweep sweep;
  sweep.tracker_from_rest = elsewhere * RigidMotion{exp_rotation({2, 0.3, 0.1}), {50, -80, 2000}};
  sweep.yaw = {0.2, 0.3, 0};
  sweep.roll = {0.1, 0.7, 1};
  cell.movers.push_back({{"platform", targets_of(paper_table1()[2], 0.3, 12)}, sweep});
  KeyedMotion passing;
  passing.keys = {{0, elsewhere * RigidMotion{exp_rotation({1, 2, 0}), {-300, 0, 1500}}},
                  {2, elsewhere * RigidMotion{exp_rotation({1.2, 2, 0.4}), {200, 100, 1600}}}};
  cell.movers.push_back({{"scanner", {{"S1", {0, 0, 40}, {}, {}, {}}}}, passing});
  cell.platform = Platform{};
  cell.scanner = Scanner{};
  cell.scanner->body_from_scanner = {exp_rotation({3, 0, 0}), {0, 0, -100}};
  cell.workpiece = Solid{"part", nullptr, "platform", {exp_rotation({0, 0, 0.5}), {10, 20, 30}}, {}};
  return cell;
}

TEST(FrameChain, CarriesAPointOfTheScanIntoThePart) {
  const Cell cell = cell_seen_from({});
  const FrameChain chain = frame_chain_at(cell, 0.7);
  const Vec3 in_scanner(5, -7, 300);
  const Vec3 in_tracker = pose_at(cell.movers[1].motion, 0.7) * cell.scanner->body_from_scanner * in_scanner;
  const Vec3 in_platform = pose_at(cell.movers[0].motion, 0.7).inverse() * in_tracker;
  const Vec3 in_workpiece = cell.workpiece->carrier_from_solid.inverse() * in_platform;
  EXPECT_LT((*chain.workpiece_from_scanner * in_scanner - in_workpiece).norm(), 1e-9);  // digits of 2000 mm
  // Eq. 22: both ways round the chain are one.
  const RigidMotion by_part =
      *chain.tracker_from_platform * *chain.platform_from_workpiece * *chain.workpiece_from_scanner;
  EXPECT_LT(difference(by_part, *chain.tracker_from_scanner).norm(), 1e-9);
}

TEST(FrameChain, HasTheTargetsFrameInTheirCentroid) {
  const Cell cell = cell_seen_from({});
  const RigidMotion frame = frame_chain_at(cell, 0).platform_from_target_centroid.value();
  const auto& targets = paper_table1()[2].targets;
  Vec3 centroid = Vec3::Zero();
  for (const Vec3& target : targets) centroid += target / static_cast<double>(targets.size());
  EXPECT_LT((frame.translation - centroid).norm(), 1e-12);
  const Vec3 x = (targets[1] - targets[0]).normalized();
  EXPECT_LT((frame.rotation * Vec3::UnitX() - x).norm(), 1e-12);
}

TEST(FrameChain, OfThePartStaysWhenTheWholeCellIsMoved) {
  const RigidMotion elsewhere{exp_rotation({0.4, -1, 2}), {3000, -800, 500}};
  const FrameChain here = frame_chain_at(cell_seen_from({}), 1.3);
  const FrameChain there = frame_chain_at(cell_seen_from(elsewhere), 1.3);
  EXPECT_LT(difference(*there.workpiece_from_scanner, *here.workpiece_from_scanner).norm(), 1e-8);
  EXPECT_LT(difference(*there.platform_from_target_centroid, *here.platform_from_target_centroid).norm(),
            1e-12);
  EXPECT_LT(difference(*there.tracker_from_platform, elsewhere * *here.tracker_from_platform).norm(), 1e-8);
}

TEST(FrameChain, LeavesOutWhatTheCellDoesNotHave) {
  Cell cell = cell_seen_from({});
  cell.scanner.reset();
  EXPECT_FALSE(frame_chain_at(cell, 0).tracker_from_scanner);
  EXPECT_FALSE(frame_chain_at(cell, 0).workpiece_from_scanner);
  EXPECT_TRUE(frame_chain_at(cell, 0).platform_from_workpiece);
  cell.platform->body = "table";
  cell.movers[0].body.targets.resize(2);
  EXPECT_FALSE(frame_chain_at(cell, 0).tracker_from_platform);
  EXPECT_FALSE(frame_chain_at(cell, 0).platform_from_target_centroid);
}

}  // namespace
}  // namespace asterism
