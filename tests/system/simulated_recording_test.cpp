// SPDX-License-Identifier: Apache-2.0
// The built-in cell through simulation and tracking: images to poses, with nothing shared but the cell.
#include <gtest/gtest.h>

#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/simulation/simulate.hpp"
#include "asterism/tracking/tracker.hpp"

namespace asterism {
namespace {

struct Tally {
  int poses = 0, wrong = 0;
  double nees = 0;  // summed
};

/// Tracks `frames` frames and holds each pose that is stated as measured against the truth.
Tally track(SimulationLevel level, int frames) {
  Cell cell = cell_of("engine_casing");
  cell.sensor.lost_frames = 0;
  SimulationOptions options;
  options.level = level;
  const Simulator simulator(cell, options);
  Tracker tracker(cell.rig, bodies_of(cell));
  Tally tally;
  for (int i = 0; i < frames; ++i) {
    const SimulatedFrame made = simulator.frame(i);
    const TrackedFrame found =
        level == SimulationLevel::Images ? tracker.process(made.image) : tracker.process(made.centres);
    for (const BodyPose& pose : found.poses) {
      if (!pose.estimate) continue;
      const RigidMotion& truth = made.truth.tracker_from_body[static_cast<std::size_t>(pose.body)];
      const Vec6 error = difference(truth, pose.estimate->tracker_from_body);
      ++tally.poses;
      tally.wrong += error.head<3>().norm() > rad_from_deg(0.5) || error.tail<3>().norm() > 2 ? 1 : 0;
      const auto whitened = solve_positive(pose.estimate->covariance, error);
      tally.nees += whitened ? error.dot(*whitened) : 1e9;
    }
  }
  return tally;
}

TEST(SimulatedRecording, IsTrackedFromImagesWithoutAWrongPose) {
  const Tally tally = track(SimulationLevel::Images, 10);
  EXPECT_GE(tally.poses, 18);  // of 20
  EXPECT_EQ(tally.wrong, 0);
}

TEST(SimulatedRecording, OfCentresHasHonestCovariances) {
  const Tally tally = track(SimulationLevel::Centres, 60);
  EXPECT_GE(tally.poses, 100);  // of 120
  EXPECT_EQ(tally.wrong, 0);
  // χ² of some 600 degrees of freedom: 1 ± 4 √(2 / 600).
  EXPECT_NEAR(tally.nees / (6.0 * tally.poses), 1.0, 0.25);
}

}  // namespace
}  // namespace asterism
