// SPDX-License-Identifier: Apache-2.0
// What is asked of a plan of views, and the arm that carries the scanner.
#include "asterism/cell/cell.hpp"
#include "asterism/io/cell_form_keys.hpp"

namespace asterism::forms {

const Form& scan() {
  static const Form form{
      "[scan]",
      {number("floor_mm", "the scanner stays above this height of the platform's frame at rest"),
       tables("region", shaped(scan_region()), "what counts more, less or not at all")},
      options_of<ScanTask>()};
  return form;
}

const Form& scan_region() {
  static const Form form{"a region",
                         {needed(text("name", "its name")),
                          table("pose", {pose_in_body()}, "of the shape in the workpiece's frame"),
                          number("weight", "of the surface inside; 0: need not be scanned; 1 unless told")}};
  return form;
}

const Form& robot() {
  static const Form form{
      "[robot]",
      {needed(table("pose", {pose(), seen_pose()}, "of its base")),
       table("flange_from_scanner_body", {pose_in_body()}, "of the scanner's body on the last joint"),
       needed(tables("joint", {robot_joint()}, "from the base on"))}};
  return form;
}

const Form& robot_joint() {
  static const Form form{
      "a joint",
      {table("pose", {pose_in_body()}, "in the joint before it, at angle 0"),
       vector("axis", "about which it turns, in its own frame; z unless told"),
       needed(table("link", {robot_link()}, "what it carries, as a capsule in its frame"))},
      options_of<RobotJoint>()};
  return form;
}

const Form& robot_link() {
  static const Form form{
      "a link",
      {needed(vector("from_mm", "centre of one end")), needed(vector("to_mm", "centre of the other")),
       needed(number("radius_mm", "of its round"))}};
  return form;
}

}  // namespace asterism::forms
