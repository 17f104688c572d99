// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_layout.hpp"

#include <fmt/format.h>

#include "asterism/io/cell_parts.hpp"
#include "asterism/io/cell_tables.hpp"
#include "asterism/io/cell_text.hpp"

namespace asterism {
namespace {

CylinderSide side_of(const CellSection& section) {
  return {section.vector_or_zero("base_mm"), section.number("radius_mm"), section.number("height_mm"),
          rad_from_deg(section.number_or("from_deg", 0)), rad_from_deg(section.number_or("to_deg", 360))};
}

Annulus annulus_of(const CellSection& section) {
  return {section.vector_or_zero("centre_mm"), section.number_or("inner_radius_mm", 0),
          section.number("outer_radius_mm"), rad_from_deg(section.number_or("from_deg", 0)),
          rad_from_deg(section.number_or("to_deg", 360))};
}

RigidMotion pose_in_body(const CellSection& section) {
  if (!section.has("pose")) return {};
  return plain_pose(section.section("pose", "a pose"));
}

NamedPatch patch_of(const CellSection& section) {
  const std::string kind = section.word("kind", words_of(forms::patches(), "kind"));
  section.must_be(form_of(forms::patches(), "kind", kind));
  const std::string name = section.text("name");
  if (kind == "cylinder-side") return {name, side_of(section)};
  if (kind == "annulus") return {name, annulus_of(section)};
  if (kind == "plate") {
    return {name, Plate{pose_in_body(section), section.number("width_mm"), section.number("height_mm")}};
  }
  return {name, CylinderRoom{section.vector_or_zero("base_mm"), section.number("radius_mm"),
                             section.number("height_mm"), rad_from_deg(section.number_or("tilt_deg", 0))}};
}

std::string angles_of(double from_rad, double to_rad) {
  return fmt::format("from_deg = {}\nto_deg = {}\n", deg_from_rad(from_rad), deg_from_rad(to_rad));
}

std::string text_of(const CylinderSide& side) {
  return fmt::format("kind = \"cylinder-side\"\nbase_mm = {}\nradius_mm = {}\nheight_mm = {}\n{}",
                     toml_of(side.base_mm), side.radius_mm, side.height_mm,
                     angles_of(side.from_rad, side.to_rad));
}
std::string text_of(const Annulus& ring) {
  return fmt::format("kind = \"annulus\"\ncentre_mm = {}\ninner_radius_mm = {}\nouter_radius_mm = {}\n{}",
                     toml_of(ring.centre_mm), ring.inner_radius_mm, ring.outer_radius_mm,
                     angles_of(ring.from_rad, ring.to_rad));
}
std::string text_of(const Plate& plate) {
  return fmt::format("kind = \"plate\"\npose = {}\nwidth_mm = {}\nheight_mm = {}\n",
                     toml_of(plate.body_from_plate), plate.width_mm, plate.height_mm);
}
std::string text_of(const CylinderRoom& room) {
  return fmt::format(
      "kind = \"cylinder-room\"\nbase_mm = {}\nradius_mm = {}\nheight_mm = {}\ntilt_deg = {}\n",
      toml_of(room.base_mm), room.radius_mm, room.height_mm, deg_from_rad(room.tilt_rad));
}

}  // namespace

WorkingVolume working_volume_of(const CellSection& section) {
  if (section.has("preset")) {
    section.must_be(forms::volume_preset());
    return working_volume_of(section.text("preset"));
  }
  section.must_be(forms::volume());
  WorkingVolume volume;
  read_options_of(section, describing_options(volume));
  return volume;
}

LayoutTask layout_task_of(const CellSection& section) {
  section.must_be(forms::layout());
  LayoutTask task;
  read_options_of(section, describing_options(task));
  for (const CellSection& patch : section.sections("patch", "a patch")) {
    task.surface.patches.push_back(patch_of(patch));
  }
  for (const CellSection& one : section.sections("keep_out", "a keep-out")) {
    const Shape shape = shape_of(one, forms::keep_out());
    task.surface.keep_outs.push_back({one.text("name"), shape, pose_in_body(one)});
  }
  task.points = points_of(section);
  return task;
}

std::string lists_of(const LayoutTask& task) {
  std::string text;
  for (const NamedPatch& one : task.surface.patches) {
    text += fmt::format("\n[[layout.patch]]\nname = {}\n", toml_of(one.name));
    text += std::visit([](const auto& patch) { return text_of(patch); }, one.patch);
  }
  for (const KeepOut& one : task.surface.keep_outs) {
    text += fmt::format("\n[[layout.keep_out]]\nname = {}\npose = {}\n{}", toml_of(one.name),
                        toml_of(one.body_from_shape), toml_of(one.shape));
  }
  for (const WorkPoint& point : task.points) {
    text += fmt::format("\n[[layout.point]]\nname = {}\nposition_mm = {}\n", toml_of(point.name),
                        toml_of(point.in_body_mm));
  }
  return text;
}

}  // namespace asterism
