// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/paper_layouts.hpp"
#include "asterism/io/cell_parts.hpp"
#include "asterism/io/cell_tables.hpp"

namespace asterism {
namespace {

RigidMotion rest_of(const Motion& motion) {
  if (const auto* sweep = std::get_if<Sweep>(&motion)) return sweep->tracker_from_rest;
  return pose_at(motion, 0);
}

Target target_of(const CellSection& section) {
  section.must_be(forms::target());
  Target target;
  target.id = section.text("id");
  target.position = section.vector("position_mm");
  if (section.has("normal")) {
    const Vec3 normal = section.vector("normal");
    if (!(normal.norm() > 0)) section.refuse("`normal` has length zero");
    target.normal = normal.normalized();
  }
  if (section.has("diameter_mm")) target.diameter_mm = section.number("diameter_mm");
  return target;
}

std::vector<Target> published_targets(const CellSection& section) {
  section.must_be(forms::published());
  const std::string name = section.text("layout");
  for (const auto* layouts : {&paper_table1(), &paper_table9()}) {
    for (const PublishedLayout& layout : *layouts) {
      if (layout.name != name) continue;
      return targets_of(layout, rad_from_deg(section.number_or("tilt_deg", 20)),
                        section.number_or("diameter_mm", 12));
    }
  }
  section.refuse("`layout` is none that was published");
}

}  // namespace

Mover mover_of(const CellSection& section, Places& places) {
  section.must_be(forms::body());
  Mover mover;
  mover.body.name = section.text("name");
  for (const CellSection& target : section.sections("target", "a target"))
    mover.body.targets.push_back(target_of(target));
  if (section.has("published")) {
    if (section.has("target")) section.refuse("a body has either `target` or `published`, not both");
    mover.body.targets = published_targets(section.section("published", "a published layout"));
  }
  mover.motion = motion_of(section.section("motion", "a motion"), mover.body.name, places);
  if (!std::holds_alternative<KeyedMotion>(mover.motion) ||
      !std::get<KeyedMotion>(mover.motion).keys.empty()) {
    places.rest.emplace_back(mover.body.name, rest_of(mover.motion));
  }
  return mover;
}

}  // namespace asterism
