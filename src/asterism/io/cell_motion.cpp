// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "asterism/io/cell_parts.hpp"
#include "asterism/io/cell_tables.hpp"
#include "asterism/io/pose_table.hpp"

namespace asterism {
namespace {

Swing swing_of(const CellSection& sweep, const char* key, bool turning) {
  if (!sweep.has(key)) return {};
  const CellSection section = sweep.section(key, "a swing");
  section.must_be(turning ? forms::turning() : forms::shifting());
  Swing swing;
  swing.amplitude = turning ? rad_from_deg(section.number("amplitude_deg")) : section.number("amplitude_mm");
  swing.frequency_hz = section.number("frequency_hz");
  swing.phase_rad = rad_from_deg(section.number_or("phase_deg", 0));
  return swing;
}

Motion sweep_of(const CellSection& section, const Places& places) {
  Sweep sweep;
  sweep.tracker_from_rest = pose_of(section.section("pose", "a pose"), places);
  sweep.pivot_mm = section.vector_or_zero("pivot_mm");
  sweep.yaw = swing_of(section, "yaw", true);
  sweep.pitch = swing_of(section, "pitch", true);
  sweep.roll = swing_of(section, "roll", true);
  sweep.x = swing_of(section, "x", false);
  sweep.y = swing_of(section, "y", false);
  sweep.z = swing_of(section, "z", false);
  if (section.has("order") && section.text("order") == "roll-pitch-yaw") {
    sweep.order = TurnOrder::RollPitchYaw;
  }
  if (section.has("from_s")) sweep.from_s = section.number("from_s");
  if (section.has("to_s")) sweep.to_s = section.number("to_s");
  return sweep;
}

Motion keyed_of(const CellSection& section, const Places& places) {
  KeyedMotion motion;
  for (const CellSection& key : section.sections("key", "a key pose")) {
    key.must_be(forms::key_pose());
    motion.keys.push_back({key.number("time_s"), pose_of(key.section("pose", "a pose"), places)});
  }
  return motion;
}

/// The poses of one body in a poses table, as keys.
Motion recorded_of(const CellSection& section, const std::string& body) {
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

}  // namespace

RigidMotion pose_of(const CellSection& section, const Places& places) {
  section.only_keys_of({forms::pose(), forms::seen_pose()});
  if (section.has("seen_at_mm")) {
    section.must_be(forms::seen_pose());
    return tracker_from_frame(
        {section.vector("seen_at_mm"), section.number("range_mm"),
         rad_from_deg(section.number("elevation_deg")), rad_from_deg(section.number_or("azimuth_deg", 0))},
        places.rig);
  }
  section.must_be(forms::pose());
  RigidMotion pose = pose_of_numbers(section);
  if (!section.has("in")) return pose;
  const std::string name = section.text("in");
  for (const auto& [body, rest] : places.rest) {
    if (body == name) return rest * pose;
  }
  section.refuse(fmt::format("`in` names body `{}`, which is not given before", name));
}

RigidMotion pose_on(const std::string& body, const CellSection& section, const Places& places) {
  if (!section.has("pose")) return {};
  const CellSection pose = section.section("pose", "a pose");
  return body.empty() ? pose_of(pose, places) : plain_pose(pose);
}

Motion motion_of(const CellSection& section, const std::string& body, const Places& places) {
  const std::string kind = section.word("kind", words_of(forms::motions(), "kind"));
  section.must_be(form_of(forms::motions(), "kind", kind));
  if (kind == "sweep") return sweep_of(section, places);
  if (kind == "keys") return keyed_of(section, places);
  if (kind == "recorded") return recorded_of(section, body);
  return at_rest(pose_of(section.section("pose", "a pose"), places));
}

}  // namespace asterism
