// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/working_volume.hpp"

#include <gtest/gtest.h>

#include "asterism/cell/cell.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

TEST(VolumeM3, IsThatOfAFrustum) {
  EXPECT_DOUBLE_EQ(volume_m3({1000, 3000, 2000, 1000, 2000, 1000}), 4.0);  // a box
  // A pyramid 1 m × 1 m × 1 m cut at half its height: (1 − 1/8) / 3.
  EXPECT_NEAR(volume_m3({500, 1000, 500, 500, 1000, 1000}), 0.875 / 3, 1e-12);
}

TEST(WorkingVolumeOf, HoldsExactlyWhatItsNameSays) {
  EXPECT_NEAR(volume_m3(working_volume_of("9.1 m3")), 9.1, 1e-12);
  EXPECT_NEAR(volume_m3(working_volume_of("16.6 m3")), 16.6, 1e-12);
  EXPECT_NEAR(working_volume_of("9.1 m3").far_mm, 3658, 1);
  EXPECT_NEAR(working_volume_of("16.6 m3").far_mm, 4431, 1);
}

TEST(WorkingVolumeOf, NamesThoseItKnows) {
  try {
    static_cast<void>(working_volume_of("9 m3"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "`9 m3` is no working volume; known are: 9.1 m3, 16.6 m3");
  }
}

TEST(ExtendedTo, KeepsTheSides) {
  const WorkingVolume base, longer = extended_to(base, 12);
  EXPECT_NEAR((longer.far_width_mm - base.near_width_mm) / (longer.far_mm - base.near_mm), 0.9, 1e-12);
  EXPECT_NEAR((longer.far_height_mm - base.near_height_mm) / (longer.far_mm - base.near_mm), 0.7, 1e-12);
}

TEST(Contains, EndsAtEachOfTheSixSides) {
  const WorkingVolume volume{1000, 3000, 800, 600, 2600, 2000};
  EXPECT_TRUE(contains(volume, {0, 0, 1000}));
  EXPECT_FALSE(contains(volume, {0, 0, 999}));
  EXPECT_FALSE(contains(volume, {0, 0, 3001}));
  EXPECT_TRUE(contains(volume, {849, 0, 2000}));
  EXPECT_FALSE(contains(volume, {851, 0, 2000}));
  EXPECT_FALSE(contains(volume, {-851, 0, 2000}));
  EXPECT_TRUE(contains(volume, {0, -649, 2000}));
  EXPECT_FALSE(contains(volume, {0, -651, 2000}));
}

TEST(TrackerFromMiddle, LooksWhereTheAxesMeet) {
  const StereoRig rig = rig_of(CameraPair{});
  const RigidMotion tracker_from_middle_ = tracker_from_middle(rig);
  const Vec3 meeting = tracker_from_middle_ * Vec3(0, 0, 2300);
  EXPECT_NEAR(meeting.x(), 0, 1e-9);
  EXPECT_NEAR(meeting.y(), 0, 1e-9);
  const Vec3 in_right = rig.right_from_left * meeting;
  EXPECT_NEAR(in_right.x(), 0, 1e-9);
  // The left camera stands half the baseline along −x.
  EXPECT_LT((tracker_from_middle_.inverse() * Vec3(0, 0, 0) - Vec3(-500, 0, 0)).norm(), 1e-9);
}

TEST(CheckWorkingVolume, RefusesAFarPlaneThatIsNear) {
  try {
    check_working_volume({3000, 1000, 800, 600, 2600, 2000}, "cell.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "cell.toml: the working volume's far plane (1000 mm) must lie beyond its near plane (3000 mm)");
  }
}

}  // namespace
}  // namespace asterism
