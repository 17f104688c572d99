// SPDX-License-Identifier: Apache-2.0
// Tracker, bodies, poses, motions and shapes.
#include "asterism/cell/cell.hpp"
#include "asterism/cell/paper_layouts.hpp"
#include "asterism/io/cell_form_keys.hpp"

namespace asterism::forms {
namespace {

Key volume_key() {
  return table("volume", {volume_preset(), volume()},
               "where the tracker is good; without it wherever both cameras see");
}

Key pose_key(const char* help) { return table("pose", {pose(), seen_pose()}, help); }

std::vector<std::string> published_names() {
  std::vector<std::string> names;
  for (const auto* layouts : {&paper_table1(), &paper_table9()}) {
    for (const PublishedLayout& layout : *layouts) names.push_back(layout.name);
  }
  return names;
}

}  // namespace

const Form& rig_file() {
  static const Form form{"[tracker]",
                         {needed(text("rig", "a rig file, sought beside the cell")), volume_key()}};
  return form;
}

const Form& lenses() {
  static const Form form{
      "[tracker]",
      {needed(table("left", {lens()}, "left lens")), needed(table("right", {lens()}, "right lens")),
       needed(table("right_from_left", {pose_in_body()}, "x_right = R x_left + T")), volume_key()}};
  return form;
}

const Form& camera_pair() {
  static const Form form{"[tracker]", {volume_key()}, options_of<CameraPair>()};
  return form;
}

const Form& lens() {
  static const Form form{
      "a lens",
      {needed(whole("width_px", "image width")), needed(whole("height_px", "image height")),
       needed(number("fx", "focal length over pixel pitch, px")),
       needed(number("fy", "the same down the image, px")), number("skew", "u = fx x + skew y + cx"),
       needed(number("cx", "principal point, px")), needed(number("cy", "principal point, px")),
       numbers("distortion", 0, "0, 4, 5, 8, 12 or 14 coefficients in OpenCV's order")}};
  return form;
}

const Form& volume_preset() {
  static const Form form{
      "[tracker.volume]",
      {needed(word("preset", working_volume_presets(), "a volume that makers of trackers state"))}};
  return form;
}

const Form& volume() {
  static const Form form{"[tracker.volume]", {}, options_of<WorkingVolume>()};
  return form;
}

const Form& pose_in_body() {
  static const Form form{"a pose in a body",
                         {vector("position_mm", "of its origin; zero unless told"),
                          vector("yaw_pitch_roll_deg", "R = Rz(yaw) Ry(pitch) Rx(roll); zero unless told"),
                          numbers("quaternion_wxyz", 4, "instead of the angles; of length 1")}};
  return form;
}

const Form& pose() {
  static const Form form =
      joined({"a pose", {text("in", "a body given before: the pose is in its frame, at rest there")}},
             pose_in_body());
  return form;
}

const Form& seen_pose() {
  static const Form form{
      "a pose",
      {needed(vector("seen_at_mm", "the point of the frame that the middle of the two cameras looks at")),
       needed(number("range_mm", "from the cameras' middle to that point")),
       needed(number("elevation_deg", "of the cameras above the frame's xy plane")),
       number("azimuth_deg", "of the cameras, from the frame's x towards its y axis; 0 unless told")}};
  return form;
}

const Form& target() {
  static const Form form{
      "a target",
      {needed(text("id", "its name")), needed(vector("position_mm", "in the body's frame")),
       vector("normal", "where the disc faces"), number("diameter_mm", "of the disc")}};
  return form;
}

const Form& published() {
  static const Form form{"a published layout",
                         {needed(word("layout", published_names(), "of the paper's tables")),
                          number("tilt_deg", "by which the targets face outwards from z; 20 unless told"),
                          number("diameter_mm", "of each disc; 12 unless told")}};
  return form;
}

const Form& body() {
  static const Form form{
      "a body",
      {needed(text("name", "its name")), tables("target", {target()}, "its targets"),
       table("published", {published()}, "its targets, as the paper has them; instead of `target`"),
       needed(table("motion", motions(), "how it moves"))}};
  return form;
}

const Form& turning() {
  static const Form form{
      "a turning swing",
      {needed(number("amplitude_deg", "amplitude sin(2 pi frequency t + phase)")),
       needed(number("frequency_hz", "swings a second")), number("phase_deg", "0 unless told")}};
  return form;
}

const Form& shifting() {
  static const Form form{
      "a shifting swing",
      {needed(number("amplitude_mm", "amplitude sin(2 pi frequency t + phase)")),
       needed(number("frequency_hz", "swings a second")), number("phase_deg", "0 unless told")}};
  return form;
}

const Form& key_pose() {
  static const Form form{
      "a key pose",
      {needed(number("time_s", "increasing from key to key")), needed(pose_key("where the body then is"))}};
  return form;
}

const std::vector<Form>& motions() {
  static const std::vector<Form> all = {
      {"a motion", {kind("kind", "rest"), needed(pose_key("where the body stands"))}},
      {"a sweep",
       {kind("kind", "sweep"), needed(pose_key("where the body rests")),
        vector("pivot_mm", "in the body's frame; its origin unless told"),
        table("yaw", {turning()}, "about z"), table("pitch", {turning()}, "about y"),
        table("roll", {turning()}, "about x"), table("x", {shifting()}, "along x at rest"),
        table("y", {shifting()}, "along y at rest"), table("z", {shifting()}, "along z at rest"),
        word("order", {"yaw-pitch-roll", "roll-pitch-yaw"},
             "R = Rz(yaw) Ry(pitch) Rx(roll), or Rx(roll) Ry(pitch) Rz(yaw)"),
        number("from_s", "at rest before"), number("to_s", "at rest after")}},
      {"a keyed motion",
       {kind("kind", "keys"), needed(tables("key", {key_pose()}, "a smooth way through all"))}},
      {"a recorded motion",
       {kind("kind", "recorded"), needed(text("file", "a poses table, sought beside the cell")),
        text("body", "its name there, where it differs")}}};
  return all;
}

const std::vector<Form>& shapes() {
  static const std::vector<Form> all = {
      {"a box",
       {kind("shape", "box"), needed(vector("size_mm", "of three edges; the pose is its centre's"))}},
      {"a capsule",
       {kind("shape", "capsule"), needed(vector("from_mm", "centre of one end")),
        needed(vector("to_mm", "centre of the other")), needed(number("radius_mm", "of its round"))}},
      {"a frustum",
       {kind("shape", "frustum"), needed(number("bottom_radius_mm", "at the pose's origin")),
        needed(number("top_radius_mm", "at its height")), needed(number("height_mm", "along z"))}}};
  return all;
}

std::vector<Form> shaped(const Form& with) {
  std::vector<Form> all;
  for (const Form& shape : shapes()) all.push_back(joined(with, shape));
  return all;
}

const Form& obstacle() {
  static const Form form{"an obstacle",
                         {needed(text("name", "its name")),
                          text("body", "that carries it; without it, it stands in the tracker's frame"),
                          pose_key("of the shape in its carrier's frame"),
                          number("level", "brightness, share of full scale; as the background unless told")}};
  return form;
}

const Form& keep_out() {
  static const Form form{
      "a keep-out",
      {needed(text("name", "its name")), table("pose", {pose_in_body()}, "of the shape in the body")}};
  return form;
}

}  // namespace asterism::forms
