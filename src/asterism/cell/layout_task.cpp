// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/layout_task.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

bool has_turn(double from_rad, double to_rad) { return std::isfinite(from_rad) && to_rad > from_rad; }
bool within_one_turn(double from_rad, double to_rad) {
  return to_rad - from_rad <= 2 * std::numbers::pi * (1 + 1e-12);
}
bool positive(double size_mm) { return size_mm > 0 && std::isfinite(size_mm); }

/// What is wrong with a patch; nothing when it is sound.
std::string fault(const CylinderSide& side) {
  if (!side.base_mm.allFinite()) return "its base is not finite";
  if (!positive(side.radius_mm) || !positive(side.height_mm)) return "its radius and height must be positive";
  if (!has_turn(side.from_rad, side.to_rad)) return "its angles must increase";
  if (!within_one_turn(side.from_rad, side.to_rad)) return "its angles span more than one turn";
  return "";
}

std::string fault(const Annulus& ring) {
  if (!ring.centre_mm.allFinite()) return "its centre is not finite";
  if (!(ring.inner_radius_mm >= 0) || !positive(ring.outer_radius_mm) ||
      !(ring.outer_radius_mm > ring.inner_radius_mm)) {
    return "its outer radius must be larger than its inner radius, and that not negative";
  }
  if (!has_turn(ring.from_rad, ring.to_rad)) return "its angles must increase";
  if (!within_one_turn(ring.from_rad, ring.to_rad)) return "its angles span more than one turn";
  return "";
}

std::string fault(const Plate& plate) {
  if (!plate.body_from_plate.translation.allFinite()) return "its pose is not finite";
  if (!positive(plate.width_mm) || !positive(plate.height_mm)) return "its width and height must be positive";
  return "";
}

std::string fault(const CylinderRoom& room) {
  if (!room.base_mm.allFinite()) return "its base is not finite";
  if (!positive(room.radius_mm) || !positive(room.height_mm)) return "its radius and height must be positive";
  if (!(std::abs(room.tilt_rad) <= 0.5 * std::numbers::pi)) return "its tilt must lie within 90 degrees";
  return "";
}

void check_patches(const DeployableSurface& surface, const std::string& where) {
  if (surface.patches.empty()) throw InputError(where, "no patch is named on which targets may stand");
  std::set<std::string> names;
  for (const NamedPatch& one : surface.patches) {
    const std::string here = fmt::format("{}: patch `{}`", where, one.name);
    if (!names.insert(one.name).second) throw InputError(here, "is given twice");
    const std::string what = std::visit([](const auto& patch) { return fault(patch); }, one.patch);
    if (!what.empty()) throw InputError(here, what);
  }
  names.clear();
  for (const KeepOut& one : surface.keep_outs) {
    const std::string here = fmt::format("{}: keep-out `{}`", where, one.name);
    if (!names.insert(one.name).second) throw InputError(here, "is given twice");
    if (!has_extent(one.shape)) throw InputError(here, "its sizes must be positive");
  }
}

void check_points(const std::vector<WorkPoint>& points, const std::string& where) {
  std::set<std::string> names;
  for (const WorkPoint& point : points) {
    const std::string here = fmt::format("{}: point `{}`", where, point.name);
    if (!names.insert(point.name).second) throw InputError(here, "is given twice");
    if (!point.in_body_mm.allFinite()) throw InputError(here, "a coordinate is not a finite number");
  }
}

}  // namespace

void describe(LayoutTask& task, OptionVisitor& visit) {
  visit.text("body", task.body, "the body whose targets are to be placed");
  visit.integer("fewest", task.fewest, {4, 64}, "fewest targets");
  visit.integer("most", task.most, {4, 64}, "most targets");
  visit.number("spacing_mm", task.spacing_mm, {0, 1e6},
               "smallest distance between the centres of two targets");
  visit.number("diameter_mm", task.diameter_mm, {0.1, 1e4}, "diameter of each target");
  visit.integer("poses", task.poses, {1, 100000}, "how often the motion is looked at, evenly in time");
  visit.integer("losses", task.losses, {0, 2}, "any so many targets may be lost");
  visit.number("loss_probability", task.loss_probability, {0, 1},
               "of each target in a frame, independently of the others");
  visit.number("identifiability_mm", task.identifiability_mm, {0, 1e3},
               "smallest RMS at which a wrong labelling may fit");
}

void check_layout_task(const LayoutTask& task, const std::string& where) {
  const std::string here = where + ": layout task";
  LayoutTask copy = task;
  LimitsCheck limits;
  try {
    describe(copy, limits);
  } catch (const InputError& error) {
    throw InputError(here, error.what());
  }
  if (task.body.empty()) throw InputError(here, "`body` must name the body whose targets are to be placed");
  if (task.most < task.fewest) {
    throw InputError(here, fmt::format("`most` is {}, below `fewest`, which is {}", task.most, task.fewest));
  }
  check_patches(task.surface, here);
  check_points(task.points, here);
}

}  // namespace asterism
