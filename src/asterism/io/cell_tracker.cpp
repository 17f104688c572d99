// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "asterism/io/cell_parts.hpp"
#include "asterism/io/cell_tables.hpp"
#include "asterism/io/rig_file.hpp"

namespace asterism {
namespace {

Lens lens_of(const CellSection& section) {
  section.must_be(forms::lens());
  Lens lens;
  lens.width_px = static_cast<int>(section.number("width_px"));
  lens.height_px = static_cast<int>(section.number("height_px"));
  lens.fx = section.number("fx");
  lens.fy = section.number("fy");
  lens.skew = section.number_or("skew", 0);
  lens.cx = section.number("cx");
  lens.cy = section.number("cy");
  if (!section.has("distortion")) return lens;
  const std::vector<double> given = section.numbers("distortion", 0);
  const std::vector<std::size_t> counts = {0, 4, 5, 8, 12, 14};
  if (std::find(counts.begin(), counts.end(), given.size()) == counts.end()) {
    section.refuse(
        fmt::format("`distortion` has {} numbers; it must have 0, 4, 5, 8, 12 or 14", given.size()));
  }
  std::copy(given.begin(), given.end(), lens.distortion.begin());
  lens.coefficients = static_cast<int>(given.size());
  return lens;
}

}  // namespace

StereoRig rig_of_section(const CellSection& section) {
  section.only_keys_of({forms::camera_pair(), forms::rig_file(), forms::lenses()});
  if (section.has("rig")) {
    section.must_be(forms::rig_file());
    return read_rig(section.file.parent_path() / section.text("rig"));
  }
  if (section.has("left") || section.has("right")) {
    section.must_be(forms::lenses());
    StereoRig rig;
    rig.left = lens_of(section.section("left", "a lens"));
    rig.right = lens_of(section.section("right", "a lens"));
    rig.right_from_left = plain_pose(section.section("right_from_left", "a pose"));
    return rig;
  }
  section.must_be(forms::camera_pair());
  CameraPair pair;
  read_options_of(section, describing_options(pair));
  return rig_of(pair);
}

}  // namespace asterism
