// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/availability.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace asterism {
namespace {

TEST(Availability, IsTheBinomialTail) {
  EXPECT_NEAR(availability(4, 0.05), std::pow(0.95, 4), 1e-15);
  // Six targets, two may be lost: 0.95⁶ + 6 · 0.95⁵ · 0.05 + 15 · 0.95⁴ · 0.05².
  EXPECT_NEAR(availability(6, 0.05), 0.997770156250, 1e-12);
  EXPECT_EQ(availability(3, 0.05), 0);
  EXPECT_EQ(availability(5, 0), 1);
  EXPECT_EQ(availability(5, 1), 0);
  EXPECT_NEAR(availability(64, 0.5, 32), 0.5 + 0.5 * 0.0993467537479669, 1e-12);
}

/// Numbers of targets that both cameras see: 6, 4, 3, 5.
MotionVisibility four_poses() {
  return {{{0b111111, 0b111111}, {0b001111, 0b111111}, {0b111000, 0b111001}, {0b011111, 0b011111}}};
}

TEST(VisibleCounts, CountsTargetsOfBothCameras) {
  EXPECT_EQ(visible_counts(four_poses()), (std::vector<int>{6, 4, 3, 5}));
  EXPECT_EQ(fewest_visible(four_poses()), 3);
  EXPECT_EQ(fewest_visible({}), 0);
}

TEST(FirstPoseBelow, IsTheFirstThatFails) {
  EXPECT_EQ(first_pose_below(four_poses()), 2U);
  EXPECT_EQ(first_pose_below(four_poses(), 5), 1U);
  EXPECT_EQ(first_pose_below(four_poses(), 3), std::nullopt);
}

TEST(AvailabilityOver, IsTheMeanAndTheWorstOfThePoses) {
  const MotionAvailability over = availability_over(four_poses(), 0.05);
  EXPECT_EQ(over.worst, 0);
  EXPECT_NEAR(over.mean, (availability(6, 0.05) + availability(4, 0.05) + availability(5, 0.05)) / 4, 1e-15);
}

}  // namespace
}  // namespace asterism
