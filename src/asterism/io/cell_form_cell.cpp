// SPDX-License-Identifier: Apache-2.0
// The file as a whole, and its tables about part, platform, layout and what goes wrong.
#include "asterism/cell/cell.hpp"
#include "asterism/io/cell_form_keys.hpp"
#include "asterism/io/mesh_scale.hpp"

namespace asterism::forms {
namespace {

Form carried(const char* of, const Form& how) {
  return joined(
      {of,
       {table("pose", {pose(), seen_pose()}, "of the solid in its carrier's frame"),
        number("level", "brightness, share of full scale; as the background unless told"),
        text("body", "that carries it; a workpiece: the platform's unless told; else the tracker's frame")}},
      how);
}

Form by_mesh() {
  return {"",
          {needed(text("mesh", "STL, OBJ, OFF or PLY file, sought beside the cell")),
           word("unit", length_unit_words(), "of the file's numbers; or say longest_mm"),
           number("longest_mm", "the file is scaled so that the longest edge of the box around it is this"),
           flag("flip", "true: the file's triangles face inwards")}};
}

Form by_casing() {
  return {"", {needed(table("casing", {casing()}, "a conical engine casing, made of numbers"))}};
}

Form fixture_with(const Form& how) {
  return joined({"a fixture", {needed(text("name", "its name"))}}, carried("", how));
}

Form workpiece_with(const Form& how) {
  return joined({"[workpiece]", {text("name", "\"workpiece\" unless told")}}, carried("", how));
}

}  // namespace

const Form& platform() {
  static const Form form{"[platform]",
                         {text("body", "the body that turns the workpiece; \"platform\" unless told"),
                          vector("pivot_mm", "about which it turns, in its frame; zero unless told"),
                          table("stroke", {stroke()}, "how far and how fast it goes"),
                          table("read_out", {read_out()}, "what it says of its own pose")}};
  return form;
}

const Form& stroke() {
  static const Form form{"[platform.stroke]", {}, options_of<Stroke>()};
  return form;
}

const Form& read_out() {
  static const Form form{"[platform.read_out]", {}, options_of<ReadOut>()};
  return form;
}

const Form& casing() {
  static const Form form{"a casing", {}, options_of<CasingShape>()};
  return form;
}

const Form& workpiece_by_mesh() {
  static const Form form = workpiece_with(by_mesh());
  return form;
}

const Form& workpiece_by_casing() {
  static const Form form = workpiece_with(by_casing());
  return form;
}

const Form& fixture() {
  static const Form form = fixture_with({});
  return form;
}

const Form& fixture_by_mesh() {
  static const Form form = fixture_with(by_mesh());
  return form;
}

const Form& fixture_by_casing() {
  static const Form form = fixture_with(by_casing());
  return form;
}

const Form& scanner() {
  static const Form form{"[scanner]",
                         {table("pose", {pose_in_body()}, "of the scanner in its body's frame")},
                         options_of<Scanner>()};
  return form;
}

const Form& scan_pass() {
  static const Form form{"a scan pass",
                         {needed(whole("scan", "its number")), needed(number("from_s", "it begins")),
                          needed(number("to_s", "it ends"))}};
  return form;
}

const Form& noise() {
  static const Form form{"[noise]", {}, options_of<NoiseModel>()};
  return form;
}

const Form& fault() {
  static const Form form{
      "a fault",
      {needed(word("kind", {"falls-off", "knocked"}, "the target is gone, or stands aside")),
       needed(text("body", "whose target")), needed(text("target", "its id")),
       number("time_s", "from when on; 0 unless told"),
       vector("shift_mm", "of a knocked target, in the body's frame")}};
  return form;
}

const Form& lamp() {
  static const Form form{
      "a lamp",
      {text("name", "its name"), needed(vector("position_mm", "of its middle, in the tracker's frame"))},
      options_of<Lamp>()};
  return form;
}

const Form& point() {
  static const Form form{
      "a point", {needed(text("name", "its name")), needed(vector("position_mm", "in the body's frame"))}};
  return form;
}

const Form& verify() {
  static const Form form{"[verify]",
                         {tables("point", {point()}, "where accuracy counts; those of [layout] unless told")},
                         options_of<Verification>()};
  return form;
}

const std::vector<Form>& patches() {
  const auto name = [] { return needed(text("name", "its name")); };
  static const std::vector<Form> all = {
      {"a cylinder-side",
       {name(), kind("kind", "cylinder-side"), vector("base_mm", "centre of the lower rim; zero unless told"),
        needed(number("radius_mm", "of the cylinder")), needed(number("height_mm", "of the cylinder")),
        number("from_deg", "0 unless told"), number("to_deg", "360 unless told")}},
      {"an annulus",
       {name(), kind("kind", "annulus"), vector("centre_mm", "zero unless told"),
        number("inner_radius_mm", "0 unless told"), needed(number("outer_radius_mm", "of the ring")),
        number("from_deg", "0 unless told"), number("to_deg", "360 unless told")}},
      {"a plate",
       {name(), kind("kind", "plate"), table("pose", {pose_in_body()}, "of its middle in the body"),
        needed(number("width_mm", "along its x")), needed(number("height_mm", "along its y"))}},
      {"a cylinder-room",
       {name(), kind("kind", "cylinder-room"), vector("base_mm", "centre of the lower end; zero unless told"),
        needed(number("radius_mm", "of the cylinder")), needed(number("height_mm", "of the cylinder")),
        number("tilt_deg", "by which targets face outwards; 0 unless told")}}};
  return all;
}

const Form& layout() {
  static const Form form{"[layout]",
                         {needed(tables("patch", patches(), "where targets may stand")),
                          tables("keep_out", shaped(keep_out()), "where nothing may stand"),
                          tables("point", {point()}, "where accuracy counts")},
                         options_of<LayoutTask>()};
  return form;
}

const Form& sensor() {
  static const Form form{"[sensor]", {}, options_of<Sensor>()};
  return form;
}

const Form& light() {
  static const Form form{"[light]", {}, options_of<Light>()};
  return form;
}

const Form& timing() {
  static const Form form{"[timing]", {}, options_of<Timing>()};
  return form;
}

const Form& cell() {
  const auto fixtures = [] {
    std::vector<Form> all = shaped(fixture());
    all.push_back(fixture_by_mesh());
    all.push_back(fixture_by_casing());
    return all;
  };
  static const Form form{
      "a cell",
      {text("name", "the file's name unless told"),
       needed(table("tracker", {camera_pair(), rig_file(), lenses()}, "the two cameras")),
       tables("body", {body()}, "what carries targets and moves"),
       tables("obstacle", shaped(obstacle()), "what hides targets, in simple shapes"),
       table("platform", {platform()}, "the body that turns the workpiece, and how far it goes"),
       table("workpiece", {workpiece_by_mesh(), workpiece_by_casing()}, "the part"),
       tables("fixture", fixtures(), "clamps, housings: what else hides targets, by mesh or shape"),
       table("scanner", {scanner()}, "the 3-D scanner"),
       tables("scan_pass", {scan_pass()}, "when the scanner measures"),
       table("scan", {scan()}, "what is asked of a plan of views"),
       table("robot", {robot()}, "the arm that carries the scanner"),
       table("sensor", {sensor()}, "the cameras' sensors"),
       table("light", {light()}, "what is bright and what is dark"),
       tables("lamp", {lamp()}, "lamps in view"), table("timing", {timing()}, "when pictures are taken"),
       table("noise", {noise()}, "how wrong everything is, for predictions"),
       tables("fault", {fault()}, "what goes wrong with a target"),
       table("verify", {verify()}, "what the cell must hold"),
       table("layout", {layout()}, "what is asked of the targets of one body")}};
  return form;
}

}  // namespace asterism::forms
