// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/observed_body.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "asterism/core/parallel.hpp"
#include "asterism/layout/cell_for_tests.hpp"
#include "asterism/simulation/simulate.hpp"
#include "asterism/tracking/tracker.hpp"

namespace asterism {
namespace {

constexpr double kSigmaPx = 0.05;

/// The paper's platform with all six targets in sight, at the level of centres: 4 s at 20 Hz.
Cell seen_cell() {
  Cell cell = paper_cell(350, 40, 2600, 0);
  for (Target& target : cell.movers[0].body.targets) {
    target.normal = Vec3::UnitZ();
    target.diameter_mm = 12;
  }
  return cell;
}

std::vector<TrackedFrame> tracked(const Cell& cell, const Body& as_filed, double dropout = 0) {
  SimulationOptions options;
  options.level = SimulationLevel::Centres;
  options.sigma_px = kSigmaPx;
  options.dropout = dropout;
  const Simulator simulator(cell, options);
  Tracker tracker(cell.rig, {as_filed});
  std::vector<TrackedFrame> frames;
  for (int i = 0; i < cell.timing.frames; ++i) frames.push_back(tracker.process(simulator.frame(i).centres));
  return frames;
}

ObservedBody observe(const Cell& cell, double dropout = 0) {
  const Body& body = cell.movers[0].body;
  return observe_body(tracked(cell, body, dropout), body, 0, cell.rig, {});
}

TEST(ObserveBody, TellsTheNoiseOfCentresAndFindsNothingWrongWhereNothingIs) {
  const ObservedBody observed = observe(seen_cell());
  EXPECT_EQ(observed.measured, observed.frames_in_all);
  // 81 frames × 24 coordinates: a robust σ of so many scatters by 1.17/√(2 · 1944) = 1.9 %.
  EXPECT_NEAR(observed.sigma_px, kSigmaPx, 4 * 0.019 * kSigmaPx);
  EXPECT_EQ(observed.unsound, 0U);
  for (const ObservedTarget& target : observed.targets) {
    EXPECT_EQ(target.seen_by_both, 1);
    EXPECT_FALSE(target.noisy);
    EXPECT_FALSE(target.displaced);
  }
  for (std::size_t i = 0; i < observed.unhidden.poses(); ++i)
    EXPECT_EQ(std::popcount(observed.unhidden.both(i) & 63U), 6);
}

TEST(ObserveBody, MissesByChanceAreNotTakenForHiding) {
  const ObservedBody observed = observe(seen_cell(), 0.05);
  int hidden = 0;
  for (std::size_t i = 0; i < observed.unhidden.poses(); ++i)
    hidden += 6 - std::popcount(observed.unhidden.both(i) & 63U);
  // Three on end: 0.05³ · 81 · 12 = 0.12 runs are expected of chance.
  EXPECT_LE(hidden, 3);
  for (const ObservedTarget& target : observed.targets) EXPECT_NEAR(target.seen_by_both, 0.95 * 0.95, 0.11);
}

TEST(ObserveBody, SeesWhichTargetIsHiddenWhen) {
  Cell cell = seen_cell();
  // A lid that moves with the platform, right above P2: hidden from both cameras all the time.
  const Vec3 p2 = cell.movers[0].body.targets[1].position;
  const RigidMotion body_from_tracker = pose_at(cell.movers[0].motion, 0).inverse();
  const Vec3 towards = (body_from_tracker.translation - p2).normalized();
  cell.obstacles.push_back({"lid", Capsule{p2 + 60 * towards, p2 + 60 * towards, 40}, "platform", {}, {}});
  const ObservedBody observed = observe(cell);
  EXPECT_LT(observed.targets[1].seen[0], 0.7);
  for (const std::size_t other : {0U, 2U, 3U, 4U, 5U}) EXPECT_GT(observed.targets[other].seen[0], 0.95);
  for (std::size_t i = 0; i < observed.frames.size(); ++i) {
    const bool unseen = !observed.frames[i].sights[1][0];
    const bool hidden = (observed.unhidden.seen[i][0] >> 1 & 1) == 0;
    EXPECT_TRUE(unseen || !hidden) << i;
  }
}

TEST(ObserveBody, NamesAKnockedTargetWithWayAndTime) {
  Cell cell = seen_cell();
  const Vec3 shift(0.8, -0.5, 0.1);
  cell.faults.push_back({FaultKind::Knocked, "platform", "P3", 1.5, shift});
  const ObservedBody observed = observe(cell);
  EXPECT_EQ(observed.unsound, 1U << 2);
  ASSERT_TRUE(observed.targets[2].displaced);
  const Displacement& found = *observed.targets[2].displaced;
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(found.mm(axis), shift(axis), 5 * found.sigma_mm(axis) + 0.01) << axis;
  ASSERT_TRUE(found.since_s);
  EXPECT_NEAR(*found.since_s, 1.5, 0.11);  // a frame or two
  for (const std::size_t other : {0U, 1U, 3U, 4U, 5U})
    EXPECT_FALSE(observed.targets[other].displaced) << other;
  // It is seen where it lies, so that learnt anew it counts.
  EXPECT_GT(observed.targets[2].seen_by_both, 0.9);
}

TEST(ObserveBody, NamesATargetThatWasLearntWrongly) {
  const Cell cell = seen_cell();
  Body wrong = cell.movers[0].body;
  wrong.targets[4].position += Vec3(0, 0.6, 0);
  const ObservedBody observed = observe_body(tracked(cell, wrong), wrong, 0, cell.rig, {});
  EXPECT_EQ(observed.unsound, 1U << 4);
  ASSERT_TRUE(observed.targets[4].displaced);
  EXPECT_FALSE(observed.targets[4].displaced->since_s);
  EXPECT_NEAR(observed.targets[4].displaced->mm.y(), -0.6, 0.05);
}

TEST(ObserveBody, StatesTheDisplacementsSigmaHonestly) {
  // Displacements of a sound target over many runs: normal with the stated σ. 2.5 σ of 24 such ratios are
  // met by chance in 1 of 100; no more than two of 24 are let pass.
  const Vec3 shift(0, 0, 0.5);
  int beyond = 0;
  double sum = 0;
  for (std::uint64_t run = 0; run < 8; ++run) {
    Cell cell = seen_cell();
    cell.timing.frames = 60;
    cell.faults.push_back({FaultKind::Knocked, "platform", "P1", -1, shift});
    SimulationOptions options;
    options.level = SimulationLevel::Centres;
    options.sigma_px = kSigmaPx;
    options.seed = run;
    const Simulator simulator(cell, options);
    Tracker tracker(cell.rig, {cell.movers[0].body});
    std::vector<TrackedFrame> frames;
    for (int i = 0; i < cell.timing.frames; ++i)
      frames.push_back(tracker.process(simulator.frame(i).centres));
    const ObservedBody observed = observe_body(frames, cell.movers[0].body, 0, cell.rig, {});
    ASSERT_TRUE(observed.targets[0].displaced);
    const Displacement& found = *observed.targets[0].displaced;
    for (int axis = 0; axis < 3; ++axis) {
      const double ratio = (found.mm(axis) - shift(axis)) / found.sigma_mm(axis);
      beyond += std::abs(ratio) > 2.5 ? 1 : 0;
      sum += ratio * ratio / 24;
    }
  }
  EXPECT_LE(beyond, 2);
  EXPECT_GT(sum, 0.3);  // mean of 24 squares: 1 ± 0.29; neither far too modest
  EXPECT_LT(sum, 2.2);  // nor too sure
}

TEST(ObserveBody, GivesTheSameBitsForAnyNumberOfThreads) {
  Cell cell = seen_cell();
  cell.faults.push_back({FaultKind::Knocked, "platform", "P3", 1.5, Vec3(0.8, -0.5, 0.1)});
  std::vector<Vec3> found;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    found.push_back(observe(cell).targets[2].displaced->mm);
  }
  set_thread_count(0);
  EXPECT_EQ(found[0], found[1]);
}

TEST(SightedFrames, CarriesPosesOverShortGapsOnly) {
  const Cell cell = seen_cell();
  const Body& body = cell.movers[0].body;
  std::vector<TrackedFrame> frames = tracked(cell, body);
  for (std::size_t i = 20; i < 24; ++i) frames[i].poses.clear();  // 0.2 s
  for (std::size_t i = 40; i < 60; ++i) frames[i].poses.clear();  // 1 s
  const auto sighted = sighted_frames(frames, body, 0, cell.rig, {});
  EXPECT_EQ(sighted.size(), frames.size() - 20);
  EXPECT_FALSE(sighted[21].measured);
  EXPECT_EQ(sighted[21].frame, 21U);
  for (const auto& target : sighted[21].sights) EXPECT_TRUE(target[0] && target[1]);
}

}  // namespace
}  // namespace asterism
