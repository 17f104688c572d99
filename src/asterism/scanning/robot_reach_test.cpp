// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/robot_reach.hpp"

#include <gtest/gtest.h>

#include "asterism/core/random.hpp"
#include "asterism/scanning/scan_cell_for_tests.hpp"

namespace asterism {
namespace {

/// Waist, shoulder, elbow and a wrist of three axes; about 1.6 m of reach.
Robot arm() {
  Robot robot;
  const auto joint = [&](const Vec3& at, const Vec3& axis, double limit_deg, const Vec3& link_to,
                         double radius) {
    robot.joints.push_back(
        {{Quaternion::Identity(), at}, axis, -limit_deg, limit_deg, {Vec3::Zero(), link_to, radius}});
  };
  joint({0, 0, 200}, Vec3::UnitZ(), 170, {0, 0, 200}, 80);
  joint({0, 0, 200}, Vec3::UnitY(), 110, {0, 0, 700}, 60);
  joint({0, 0, 700}, Vec3::UnitY(), 130, {0, 0, 600}, 50);
  joint({0, 0, 600}, Vec3::UnitZ(), 180, {0, 0, 1}, 40);
  joint({0, 0, 0}, Vec3::UnitY(), 120, {0, 0, 100}, 40);
  joint({0, 0, 100}, Vec3::UnitZ(), 350, {0, 0, 1}, 40);
  return robot;
}

TEST(JointAngles, LeadBackToWhereTheArmWas) {
  const Robot robot = arm();
  int found = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    RandomStream random(2, i);
    std::vector<double> angles;
    for (const RobotJoint& joint : robot.joints) {
      angles.push_back(0.8 * rad_from_deg(random.uniform(joint.lowest_deg, joint.highest_deg)));
    }
    const RigidMotion there = flange_of(robot, angles);
    const auto again = joint_angles(robot, there);
    if (!again) continue;
    ++found;
    EXPECT_LT(difference(flange_of(robot, *again), there).tail<3>().norm(), 0.02);
    for (std::size_t j = 0; j < again->size(); ++j) {
      EXPECT_LE(std::abs((*again)[j]), rad_from_deg(robot.joints[j].highest_deg) + 1e-12);
    }
  }
  EXPECT_GE(found, 57);  // twelve starts miss one place in a few hundred
}

TEST(JointAngles, AreNoneBeyondTheArm) {
  EXPECT_FALSE(joint_angles(arm(), {Quaternion::Identity(), {2500, 0, 400}}));
}

Cell cell_with_arm() {
  Cell cell = scene::scan_cell();
  cell.robot = arm();
  cell.robot->tracker_from_base =
      pose_at(cell.movers[0].motion, 0) * RigidMotion{Quaternion::Identity(), {1100, 0, -200}};
  return cell;
}

bool reaches(const Cell& cell, const Vec3& in_platform) {
  const RigidMotion part = pose_at(cell.movers[0].motion, 0);
  return RobotReach(cell).reaches(part * RigidMotion{exp_rotation({0, -1.5, 0}), in_platform}, part);
}

TEST(RobotReach, GoesWhereItCan) {
  EXPECT_TRUE(reaches(cell_with_arm(), {450, 0, 300}));
  EXPECT_FALSE(reaches(cell_with_arm(), {-1500, 0, 300}));
}

TEST(RobotReach, KeepsItsLinksOffWhatStandsThere) {
  Cell cell = cell_with_arm();
  const TriangleMesh wall = moved(surface_of_revolution({{0, 0}, {2000, 0}, {2000, 10}, {0, 10}}, 24),
                                  {exp_rotation({0, std::numbers::pi / 2, 0}), {800, 0, 0}});
  cell.fixtures = {Solid{"wall", std::make_shared<const TriangleMesh>(wall), "platform", {}, {}}};
  EXPECT_FALSE(reaches(cell, {450, 0, 300}));
}

}  // namespace
}  // namespace asterism
