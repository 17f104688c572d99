// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/cell.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

Cell sound_cell() {
  Cell cell;
  cell.rig = rig_of({});
  cell.movers.push_back({{"platform", {{"P1", {0, 0, 0}, Vec3::UnitZ(), 12.0, {}}}}, at_rest({})});
  return cell;
}

std::string complaint(const Cell& cell) {
  try {
    check_cell(cell, "cell.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RigOf, PutsTheAxesTogetherAtTheRange) {
  const StereoRig rig = rig_of({});
  EXPECT_NEAR(rig.baseline_mm(), 1000, 1e-9);
  const RigidMotion left_from_right = rig.right_from_left.inverse();
  const double along = std::hypot(2300.0, 500.0);
  const Vec3 on_left(0, 0, along);
  EXPECT_LT((left_from_right * on_left - on_left).norm(), 1e-9);
  EXPECT_NO_THROW(check_rig(rig, "pair"));
}

TEST(TrackerFromFrame, PutsThePointAheadOfTheMiddleAtItsRange) {
  const StereoRig rig = rig_of({});
  const SeenFrom seen{{0, 0, 600}, 2300, rad_from_deg(60), rad_from_deg(45)};
  const RigidMotion tracker_from_frame_ = tracker_from_frame(seen, rig);
  const Vec3 point = tracker_from_frame_ * seen.at_mm;
  const Vec3 middle = 0.5 * rig.right_from_left.inverse().translation;
  EXPECT_NEAR((point - middle).norm(), 2300, 1e-9);
  // Where both axes meet: in the centre of both images.
  const auto left = project(rig.left, point);
  const auto right = project(rig.right, rig.right_from_left * point);
  ASSERT_TRUE(left && right);
  EXPECT_LT((left->px - Vec2(1023.5, 767.5)).norm(), 1e-6);
  EXPECT_LT((right->px - Vec2(1023.5, 767.5)).norm(), 1e-6);
  // The camera stands 60° above the frame's plane, and the frame's z points up in the image.
  const Vec3 camera_in_frame = tracker_from_frame_.inverse() * middle - seen.at_mm;
  EXPECT_NEAR(camera_in_frame.z() / camera_in_frame.norm(), std::sin(rad_from_deg(60)), 1e-12);
  EXPECT_NEAR(camera_in_frame.x(), camera_in_frame.y(), 1e-9);
  EXPECT_LT((tracker_from_frame_.rotation * Vec3::UnitZ()).y(), 0);
}

TEST(CheckCell, TakesASoundCell) { EXPECT_EQ(complaint(sound_cell()), ""); }

TEST(CheckCell, SaysWhatIsWrong) {
  Cell cell = sound_cell();
  cell.obstacles.push_back({"pipe", Capsule{}, "plattform", {}, {}});
  EXPECT_EQ(complaint(cell),
            "cell.toml: obstacle `pipe`: it moves with body `plattform`, which is not there; "
            "bodies are: platform");
  cell = sound_cell();
  cell.obstacles.push_back({"plate", Box{{10, 0, 10}}, "", {}, {}});
  EXPECT_EQ(complaint(cell), "cell.toml: obstacle `plate`: its sizes must be positive");
  cell = sound_cell();
  cell.movers[0].motion = KeyedMotion{{{1.0, {}}, {1.0, {}}}};
  EXPECT_EQ(complaint(cell),
            "cell.toml: body `platform`: the times of its poses must increase; 1 s follows 1 s");
  cell = sound_cell();
  cell.sensor.bits = 10;
  EXPECT_EQ(complaint(cell), "cell.toml: `bits` is 10; it must be 8 or 16");
  cell = sound_cell();
  cell.sensor.read_noise_e = -1;
  EXPECT_EQ(complaint(cell), "cell.toml: `read_noise_e` is -1; it must lie between 0 and 1000000");
}

}  // namespace
}  // namespace asterism
