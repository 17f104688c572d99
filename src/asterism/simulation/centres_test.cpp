// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/centres.hpp"

#include <gtest/gtest.h>

#include "asterism/camera/disc_image.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/simulation/test_cell.hpp"
#include "asterism/simulation/truth.hpp"

namespace asterism {
namespace {

SimulationOptions centres_with(double sigma_px) {
  SimulationOptions options;
  options.level = SimulationLevel::Centres;
  options.sigma_px = sigma_px;
  return options;
}

TEST(SimulateCentres, WithoutNoiseAreTheCentresOfTheConics) {
  const Simulator simulator(test_cell(), centres_with(0));
  const SimulatedFrame made = simulator.frame(7);
  ASSERT_EQ(made.centres.left.size(), 6U);
  ASSERT_EQ(made.centres.right.size(), 6U);
  const RigidMotion pose = made.truth.tracker_from_body[0];
  for (const Target& target : simulator.cell().movers[0].body.targets) {
    const auto conic = project_disc_centre(simulator.cell().rig.left,
                                           {pose * target.position, pose.rotation * *target.normal, 6});
    double nearest = 1e9;
    for (const Centre& centre : made.centres.left)
      nearest = std::min(nearest, (centre.px() - conic->px).norm());
    EXPECT_LT(nearest, 1e-6);
  }
}

TEST(SimulateCentres, HaveTheStatedSigma) {
  const Cell cell = test_cell();
  const FrameTruth truth = truth_of(stage_of(cell), 0.3);
  double sum = 0;
  int count = 0;
  for (int frame = 0; frame < 2000; ++frame) {
    for (const Centre& centre : simulate_centres(cell, truth, Side::Right, frame, centres_with(0.05))) {
      for (const TargetTruth& target : truth.targets) {
        const Vec2 error = centre.px() - target.image.centre;
        if (target.side != Side::Right || error.norm() > 2) continue;
        sum += error.squaredNorm();
        count += 2;
      }
    }
  }
  ASSERT_EQ(count, 2000 * 6 * 2);
  EXPECT_NEAR(std::sqrt(sum / count), 0.05, 4 * 0.05 / std::sqrt(2.0 * count));
}

TEST(SimulateCentres, DropAndAddTheStatedShares) {
  const Cell cell = test_cell();
  const FrameTruth truth = truth_of(stage_of(cell), 0.3);
  SimulationOptions options = centres_with(0.02);
  options.dropout = 0.2;
  std::size_t kept = 0;
  for (int frame = 0; frame < 2000; ++frame)
    kept += simulate_centres(cell, truth, Side::Left, frame, options).size();
  EXPECT_NEAR(static_cast<double>(kept) / 12000, 0.8, 4 * std::sqrt(0.16 / 12000));
  options.dropout = 0;
  options.clutter = 5;
  kept = 0;
  for (int frame = 0; frame < 2000; ++frame)
    kept += simulate_centres(cell, truth, Side::Left, frame, options).size();
  EXPECT_NEAR(static_cast<double>(kept) / 2000, 11, 4 * std::sqrt(5.0 / 2000));
}

TEST(SimulateCentres, LoseTheSameTargetsToBothCamerasAsOftenAsTheCellSays) {
  Cell cell = test_cell();
  const FrameTruth truth = truth_of(stage_of(cell), 0.3);
  const auto whole = simulate_centres(cell, truth, Side::Left, 7, centres_with(0.02));
  cell.noise.target_loss = 0.3;
  std::size_t kept = 0;
  for (int frame = 0; frame < 2000; ++frame) {
    const auto left = simulate_centres(cell, truth, Side::Left, frame, centres_with(0.02));
    EXPECT_EQ(left.size(), simulate_centres(cell, truth, Side::Right, frame, centres_with(0.02)).size());
    kept += left.size();
  }
  EXPECT_NEAR(static_cast<double>(kept) / 12000, 0.7, 4 * std::sqrt(0.21 / 12000));
  // Those that are kept have the noise that they had.
  for (const Centre& centre : simulate_centres(cell, truth, Side::Left, 7, centres_with(0.02))) {
    const auto same = [&](const Centre& other) { return other.px() == centre.px(); };
    EXPECT_TRUE(std::any_of(whole.begin(), whole.end(), same));
  }
}

TEST(Simulator, LosesFramesOfEachCameraByItself) {
  Cell cell = test_cell();
  cell.sensor.lost_frames = 0.25;
  const Simulator simulator(cell, centres_with(0.02));
  int left = 0, both = 0;
  for (int i = 0; i < 1000; ++i) {
    const SimulatedFrame made = simulator.frame(i);
    left += made.centres.left.empty() ? 1 : 0;
    both += made.centres.left.empty() && made.centres.right.empty() ? 1 : 0;
  }
  EXPECT_NEAR(left, 250, 4 * std::sqrt(1000 * 0.25 * 0.75));
  EXPECT_NEAR(both, 62.5, 4 * std::sqrt(62.5));
}

TEST(Simulator, NeedsADiameterToDrawATarget) {
  Cell cell = test_cell();
  cell.movers[0].body.targets[2].diameter_mm.reset();
  EXPECT_NO_THROW(Simulator(cell, centres_with(0.02)));
  try {
    const Simulator simulator(cell, {});
    FAIL() << "drew a target without a diameter";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "test cell: target `P3` of body `platform` has no diameter_mm; without it no image can be drawn");
  }
}

}  // namespace
}  // namespace asterism
