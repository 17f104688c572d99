// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "asterism/cell/cell_checks.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

void check_keys(const KeyedMotion& motion, const std::string& where) {
  if (motion.keys.empty()) throw InputError(where, "its motion has no poses");
  for (std::size_t i = 1; i < motion.keys.size(); ++i) {
    if (motion.keys[i].time_s > motion.keys[i - 1].time_s) continue;
    throw InputError(where, fmt::format("the times of its poses must increase; {} s follows {} s",
                                        motion.keys[i].time_s, motion.keys[i - 1].time_s));
  }
}

/// A sweep that begins or ends must do so where nothing swings away from rest.
void check_window(const Sweep& sweep, const std::string& where) {
  if (sweep.from_s && sweep.to_s && !(*sweep.to_s > *sweep.from_s)) {
    throw InputError(where, fmt::format("its sweep ends at {} s, not after it begins at {} s", *sweep.to_s,
                                        *sweep.from_s));
  }
  for (const std::optional<double>& end : {sweep.from_s, sweep.to_s}) {
    if (!end) continue;
    for (const Swing* swing : {&sweep.yaw, &sweep.pitch, &sweep.roll, &sweep.x, &sweep.y, &sweep.z}) {
      if (std::abs(swing->at(*end)) <= 1e-6 * std::abs(swing->amplitude)) continue;
      throw InputError(where,
                       fmt::format("its sweep jumps at {} s, where a swing is away from rest; choose the "
                                   "phase so that it passes through rest there",
                                   *end));
    }
  }
}

void check_motion(const Motion& motion, const std::string& where) {
  if (const auto* keyed = std::get_if<KeyedMotion>(&motion)) return check_keys(*keyed, where);
  check_window(std::get<Sweep>(motion), where);
}

void check_obstacle(const Obstacle& obstacle, const Cell& cell, const std::string& where) {
  const std::string here = fmt::format("{}: obstacle `{}`", where, obstacle.name);
  if (!has_extent(obstacle.shape)) {
    throw InputError(here, "its sizes must be positive");
  }
  if (!obstacle.body.empty()) check_carrier(obstacle.body, cell, here, "it moves with");
}

void check_fault(const TargetFault& fault, const Cell& cell, const std::string& where) {
  const std::string here = fmt::format("{}: the fault at {} s", where, fault.time_s);
  check_carrier(fault.body, cell, here, "is of a target of");
  if (!std::isfinite(fault.time_s)) throw InputError(here, "its time is not a finite number");
  if (!fault.shift_mm.allFinite()) throw InputError(here, "its shift is not a finite number");
  std::vector<std::string> ids;
  for (const Mover& mover : cell.movers) {
    if (mover.body.name != fault.body) continue;
    for (const Target& target : mover.body.targets) ids.push_back(target.id);
  }
  if (std::find(ids.begin(), ids.end(), fault.target) != ids.end()) return;
  throw InputError(here, fmt::format("body `{}` has no target `{}`; its targets are: {}", fault.body,
                                     fault.target, fmt::join(ids, ", ")));
}

void check_verification(const Verification& verification, const Cell& cell, const std::string& where) {
  const std::string here = where + ": [verify]";
  if (!verification.body.empty()) check_carrier(verification.body, cell, here, "it is of");
  std::set<std::string> names;
  for (const WorkPoint& point : verification.points) {
    if (!names.insert(point.name).second) {
      throw InputError(here, fmt::format("point `{}` is given twice", point.name));
    }
    if (point.in_body_mm.allFinite()) continue;
    throw InputError(here, fmt::format("point `{}`: a coordinate is not a finite number", point.name));
  }
}

void check_lamps(const Cell& cell, const std::string& where) {
  for (const Lamp& lamp : cell.lamps) {
    if (lamp.in_tracker_mm.allFinite()) continue;
    throw InputError(where, fmt::format("lamp `{}`: its place is not a finite number", lamp.name));
  }
}

/// Every option of the cell lies within the limits that its describe() states.
void check_options(Cell cell, const std::string& where) {
  LimitsCheck limits;
  try {
    describe(cell.sensor, limits);
    describe(cell.light, limits);
    describe(cell.timing, limits);
    describe(cell.noise, limits);
    describe(cell.verification, limits);
    for (Lamp& lamp : cell.lamps) describe(lamp, limits);
    if (cell.scanner) describe(*cell.scanner, limits);
    if (cell.platform) describe(cell.platform->stroke, limits);
    if (cell.platform) describe(cell.platform->read_out, limits);
  } catch (const InputError& error) {
    throw InputError(where, error.what());
  }
  if (cell.sensor.bits != 8 && cell.sensor.bits != 16) {
    throw InputError(where, fmt::format("`bits` is {}; it must be 8 or 16", cell.sensor.bits));
  }
}

}  // namespace

void check_carrier(const std::string& body, const Cell& cell, const std::string& where, const char* what) {
  std::vector<std::string> names;
  for (const Mover& mover : cell.movers) names.push_back(mover.body.name);
  if (std::find(names.begin(), names.end(), body) != names.end()) return;
  throw InputError(where, fmt::format("{} body `{}`, which is not there; bodies are: {}", what, body,
                                      fmt::join(names, ", ")));
}

void check_cell(const Cell& cell, const std::string& where) {
  check_rig(cell.rig, where);
  check_bodies(bodies_of(cell), where);
  for (const Mover& mover : cell.movers) {
    check_motion(mover.motion, fmt::format("{}: body `{}`", where, mover.body.name));
  }
  check_options(cell, where);
  for (const Obstacle& obstacle : cell.obstacles) check_obstacle(obstacle, cell, where);
  check_solids(cell, where);
  check_platform_motion(cell, where);
  check_scanner(cell, where);
  check_scan_task(cell, where);
  check_robot(cell, where);
  for (const TargetFault& fault : cell.faults) check_fault(fault, cell, where);
  check_lamps(cell, where);
  check_verification(cell.verification, cell, where);
  if (cell.volume) check_working_volume(*cell.volume, where);
  if (!cell.layout) return;
  check_layout_task(*cell.layout, where);
  check_carrier(cell.layout->body, cell, where, "the layout task is for");
}

}  // namespace asterism
