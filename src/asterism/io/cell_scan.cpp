// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_scan.hpp"

#include <fmt/format.h>

#include "asterism/io/cell_parts.hpp"
#include "asterism/io/cell_text.hpp"

namespace asterism {
namespace {

RigidMotion pose_or_none(const CellSection& section, const std::string& key) {
  return section.has(key) ? plain_pose(section.section(key, "a pose")) : RigidMotion{};
}

ScanRegion region_of(const CellSection& section) {
  ScanRegion region;
  region.shape = shape_of(section, forms::scan_region());
  region.name = section.text("name");
  region.workpiece_from_shape = pose_or_none(section, "pose");
  region.weight = section.number_or("weight", 1);
  return region;
}

RobotJoint joint_of(const CellSection& section) {
  section.must_be(forms::robot_joint());
  RobotJoint joint;
  read_options_of(section, describing_options(joint));
  joint.parent_from_joint = pose_or_none(section, "pose");
  if (section.has("axis")) {
    const Vec3 axis = section.vector("axis");
    if (!(axis.norm() > 0)) section.refuse("`axis` has length zero");
    joint.axis = axis.normalized();
  }
  const CellSection link = section.section("link", "a link");
  link.must_be(forms::robot_link());
  joint.link = {link.vector("from_mm"), link.vector("to_mm"), link.number("radius_mm")};
  return joint;
}

}  // namespace

ScanTask scan_task_of(const CellSection& section) {
  section.must_be(forms::scan());
  ScanTask task;
  read_options_of(section, describing_options(task));
  if (section.has("floor_mm")) task.floor_mm = section.number("floor_mm");
  for (const CellSection& region : section.sections("region", "a region")) {
    task.regions.push_back(region_of(region));
  }
  return task;
}

Robot robot_of(const CellSection& section, const Places& places) {
  section.must_be(forms::robot());
  Robot robot;
  robot.tracker_from_base = pose_of(section.section("pose", "a pose"), places);
  robot.flange_from_scanner_body = pose_or_none(section, "flange_from_scanner_body");
  for (const CellSection& joint : section.sections("joint", "a joint")) {
    robot.joints.push_back(joint_of(joint));
  }
  return robot;
}

std::string rest_of(const ScanTask& task) {
  std::string text;
  if (task.floor_mm) text += fmt::format("floor_mm = {}\n", *task.floor_mm);
  for (const ScanRegion& region : task.regions) {
    text += fmt::format("\n[[scan.region]]\nname = {}\npose = {}\nweight = {}\n{}", toml_of(region.name),
                        toml_of(region.workpiece_from_shape), region.weight, toml_of(region.shape));
  }
  return text;
}

std::string text_of(const Robot& robot) {
  std::string text = fmt::format("\n[robot]\npose = {}\nflange_from_scanner_body = {}\n",
                                 toml_of(robot.tracker_from_base), toml_of(robot.flange_from_scanner_body));
  for (const RobotJoint& joint : robot.joints) {
    text += fmt::format(
        "\n[[robot.joint]]\npose = {}\naxis = {}\nlowest_deg = {}\nhighest_deg = {}\n"
        "link = {{from_mm = {}, to_mm = {}, radius_mm = {}}}\n",
        toml_of(joint.parent_from_joint), toml_of(joint.axis), joint.lowest_deg, joint.highest_deg,
        toml_of(joint.link.from_mm), toml_of(joint.link.to_mm), joint.link.radius_mm);
  }
  return text;
}

}  // namespace asterism
