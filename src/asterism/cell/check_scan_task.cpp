// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "asterism/cell/cell_checks.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

void check_region(const ScanRegion& region, const std::string& where) {
  const std::string here = fmt::format("{}: [scan], region `{}`", where, region.name);
  if (!has_extent(region.shape)) throw InputError(here, "its sizes must be positive");
  if (!(region.weight >= 0 && std::isfinite(region.weight))) {
    throw InputError(here, fmt::format("its weight is {}; it must be 0 or more", region.weight));
  }
}

}  // namespace

void check_scan_task(const Cell& cell, const std::string& where) {
  ScanTask task = cell.scan_task;
  LimitsCheck limits;
  try {
    describe(task, limits);
  } catch (const InputError& error) {
    throw InputError(where + ": [scan]", error.what());
  }
  if (task.floor_mm && !std::isfinite(*task.floor_mm)) {
    throw InputError(where + ": [scan]", "`floor_mm` is not a finite number");
  }
  std::set<std::string> names;
  for (const ScanRegion& region : task.regions) {
    check_region(region, where);
    if (!names.insert(region.name).second) {
      throw InputError(where + ": [scan]", fmt::format("region `{}` is given twice", region.name));
    }
  }
}

void check_robot(const Cell& cell, const std::string& where) {
  if (!cell.robot) return;
  const std::string here = where + ": [robot]";
  if (!cell.scanner) throw InputError(here, "it carries a scanner, and the cell has no [scanner]");
  if (cell.robot->joints.empty()) throw InputError(here, "it has no joints");
  for (std::size_t i = 0; i < cell.robot->joints.size(); ++i) {
    RobotJoint joint = cell.robot->joints[i];
    const std::string one = fmt::format("{}, joint {}", here, i + 1);
    LimitsCheck limits;
    try {
      describe(joint, limits);
    } catch (const InputError& error) {
      throw InputError(one, error.what());
    }
    if (!(joint.highest_deg > joint.lowest_deg)) {
      throw InputError(one, fmt::format("`highest_deg` is {}; it must be more than `lowest_deg`, {}",
                                        joint.highest_deg, joint.lowest_deg));
    }
    if (!(std::abs(joint.axis.norm() - 1) < 1e-6)) throw InputError(one, "its axis must have length 1");
    if (!has_extent(joint.link)) throw InputError(one, "the radius of its link must be positive");
  }
}

}  // namespace asterism
