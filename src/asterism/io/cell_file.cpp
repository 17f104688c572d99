// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "asterism/core/result.hpp"
#include "asterism/io/builtin_cells.hpp"
#include "asterism/io/cell_keys.hpp"
#include "asterism/io/cell_layout.hpp"
#include "asterism/io/cell_parts.hpp"
#include "asterism/io/cell_section.hpp"
#include "asterism/io/pose_table.hpp"
#include "asterism/io/rig_file.hpp"

namespace asterism {
namespace {

using namespace cell_keys;

Lens lens_of(const CellSection& section) {
  section.only(kLens);
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

/// What poses may refer to: the rig, and where the bodies given before are at rest.
struct Places {
  StereoRig rig;
  std::vector<std::pair<std::string, RigidMotion>> rest;
};

RigidMotion pose_of(const CellSection& section, const Places& places) {
  if (section.has("seen_at_mm")) {
    section.only(kSeenPose);
    return tracker_from_frame(
        {section.vector("seen_at_mm"), section.number("range_mm"),
         rad_from_deg(section.number("elevation_deg")), rad_from_deg(section.number_or("azimuth_deg", 0))},
        places.rig);
  }
  section.only(both(kPose, kSeenPose));
  RigidMotion pose = plain_pose(section);
  if (!section.has("in")) return pose;
  const std::string name = section.text("in");
  for (const auto& [body, rest] : places.rest) {
    if (body == name) return rest * pose;
  }
  section.refuse(fmt::format("`in` names body `{}`, which is not given before", name));
}

Swing swing_of(const CellSection& sweep, const char* key, bool turning) {
  if (!sweep.has(key)) return {};
  const CellSection section = sweep.section(key, turning ? "a turning swing" : "a shifting swing");
  section.only(turning ? kTurning : kShifting);
  Swing swing;
  swing.amplitude = turning ? rad_from_deg(section.number("amplitude_deg")) : section.number("amplitude_mm");
  swing.frequency_hz = section.number("frequency_hz");
  swing.phase_rad = rad_from_deg(section.number_or("phase_deg", 0));
  return swing;
}

Motion sweep_of(const CellSection& section, const Places& places) {
  section.only(kSweep);
  Sweep sweep;
  sweep.tracker_from_rest = pose_of(section.section("pose", "a pose"), places);
  sweep.pivot_mm = section.vector_or_zero("pivot_mm");
  sweep.yaw = swing_of(section, "yaw", true);
  sweep.pitch = swing_of(section, "pitch", true);
  sweep.roll = swing_of(section, "roll", true);
  sweep.x = swing_of(section, "x", false);
  sweep.y = swing_of(section, "y", false);
  sweep.z = swing_of(section, "z", false);
  return sweep;
}

Motion keyed_of(const CellSection& section, const Places& places) {
  section.only(kKeyed);
  KeyedMotion motion;
  for (const CellSection& key : section.sections("key", "a key pose")) {
    key.only(kKeyPose);
    motion.keys.push_back({key.number("time_s"), pose_of(key.section("pose", "a pose"), places)});
  }
  return motion;
}

/// The poses of one body in a poses table, as keys.
Motion recorded_of(const CellSection& section, const std::string& body) {
  section.only(kRecorded);
  const std::filesystem::path file = section.file.parent_path() / section.text("file");
  const std::string recorded = section.has("body") ? section.text("body") : body;
  KeyedMotion motion;
  for (const PoseRecord& record : read_poses(file)) {
    if (record.body == recorded && record.tracker_from_body)
      motion.keys.push_back({record.time_s, *record.tracker_from_body});
  }
  if (motion.keys.empty())
    section.refuse(fmt::format("{} has no pose of body `{}`", file.string(), recorded));
  return motion;
}

Motion motion_of(const CellSection& section, const std::string& body, const Places& places) {
  const std::string kind = section.word("kind", kMotions);
  if (kind == "sweep") return sweep_of(section, places);
  if (kind == "keys") return keyed_of(section, places);
  if (kind == "recorded") return recorded_of(section, body);
  section.only(kAtRest);
  return at_rest(pose_of(section.section("pose", "a pose"), places));
}

RigidMotion rest_of(const Motion& motion) {
  if (const auto* sweep = std::get_if<Sweep>(&motion)) return sweep->tracker_from_rest;
  return pose_at(motion, 0);
}

Target target_of(const CellSection& section) {
  section.only(kTarget);
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

Mover mover_of(const CellSection& section, Places& places) {
  section.only(kBody);
  Mover mover;
  mover.body.name = section.text("name");
  for (const CellSection& target : section.sections("target", "a target"))
    mover.body.targets.push_back(target_of(target));
  mover.motion = motion_of(section.section("motion", "a motion"), mover.body.name, places);
  if (!std::holds_alternative<KeyedMotion>(mover.motion) ||
      !std::get<KeyedMotion>(mover.motion).keys.empty()) {
    places.rest.emplace_back(mover.body.name, rest_of(mover.motion));
  }
  return mover;
}

Obstacle obstacle_of(const CellSection& section, const Places& places) {
  Obstacle obstacle;
  obstacle.shape = shape_of(section, kObstacle);
  obstacle.name = section.text("name");
  if (section.has("body")) obstacle.body = section.text("body");
  if (section.has("pose")) obstacle.carrier_from_shape = pose_of(section.section("pose", "a pose"), places);
  if (section.has("level")) obstacle.level = section.number("level");
  return obstacle;
}

StereoRig rig_of_section(const CellSection& section) {
  if (section.has("rig")) {
    section.only(both(kRigFile, kVolume));
    return read_rig(section.file.parent_path() / section.text("rig"));
  }
  if (section.has("left") || section.has("right")) {
    section.only(both(kLenses, kVolume));
    StereoRig rig;
    rig.left = lens_of(section.section("left", "a lens"));
    rig.right = lens_of(section.section("right", "a lens"));
    rig.right_from_left = plain_pose(section.section("right_from_left", "a pose"));
    return rig;
  }
  CameraPair pair;
  section.only(both(both(option_names(describing_options(pair)), both(kRigFile, kLenses)), kVolume));
  read_options_of(section, describing_options(pair));
  return rig_of(pair);
}

template <class Options>
void read_part(const CellSection& root, const char* key, Options& options) {
  if (!root.has(key)) return;
  const CellSection section = root.section(key, fmt::format("[{}]", key));
  section.only(option_names(describing_options(options)));
  read_options_of(section, describing_options(options));
}

Cell cell_of_toml(const std::filesystem::path& file, const toml::table& table) {
  const CellSection root{file, table, "a cell"};
  root.only(kRoot);
  Cell cell;
  cell.name = root.has("name") ? root.text("name") : file.stem().string();
  const CellSection tracker = root.section("tracker", "[tracker]");
  cell.rig = rig_of_section(tracker);
  if (tracker.has("volume")) cell.volume = working_volume_of(tracker.section("volume", "[tracker.volume]"));
  Places places{cell.rig, {}};
  for (const CellSection& body : root.sections("body", "a body"))
    cell.movers.push_back(mover_of(body, places));
  for (const CellSection& one : root.sections("obstacle", "an obstacle"))
    cell.obstacles.push_back(obstacle_of(one, places));
  read_part(root, "sensor", cell.sensor);
  read_part(root, "light", cell.light);
  read_part(root, "timing", cell.timing);
  if (root.has("layout")) cell.layout = layout_task_of(root.section("layout", "[layout]"));
  check_cell(cell, file.string());
  return cell;
}

}  // namespace

Cell read_cell(const std::filesystem::path& file) { return cell_of_toml(file, parse_toml(file)); }

std::vector<std::string> builtin_cells() {
  std::vector<std::string> names;
  for (const BuiltinCell& cell : builtin_cell_texts()) names.emplace_back(cell.name);
  return names;
}

Cell cell_of(const std::string& name_or_file) {
  for (const BuiltinCell& cell : builtin_cell_texts()) {
    if (cell.name == name_or_file) return cell_of_toml(name_or_file, toml::parse(cell.toml));
  }
  if (!std::filesystem::exists(name_or_file)) {
    throw InputError(name_or_file, fmt::format("is neither a file nor a built-in cell; built in are: {}",
                                               fmt::join(builtin_cells(), ", ")));
  }
  return read_cell(name_or_file);
}

}  // namespace asterism
