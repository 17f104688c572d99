// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/stage.hpp"

#include <fmt/format.h>

#include <utility>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

StageSolid ready(const Cell& cell, const Solid& solid) {
  const TriangleMesh surface = moved(*solid.surface, solid.carrier_from_solid);
  return {mover_index(cell, solid.body), RayScene(surface), slabs_of(surface)};
}

/// What is seen of the cell in its pictures. Lines that a lens bends are drawn in pieces of some 60 px.
std::vector<DrawnSurface> surfaces_of(const Cell& cell) {
  const bool bends = cell.rig.left.coefficients > 0 || cell.rig.right.coefficients > 0;
  const double longest_mm = bends ? 40 : 0;
  std::vector<DrawnSurface> surfaces;
  const auto add = [&](const TriangleMesh& mesh, const RigidMotion& carrier_from_mesh,
                       const std::string& body, const std::optional<double>& level) {
    if (!level || mesh.empty()) return;
    surfaces.push_back(
        drawn_surface(moved(mesh, carrier_from_mesh), mover_index(cell, body), *level, longest_mm));
  };
  const auto add_solid = [&](const Solid& solid) {
    add(*solid.surface, solid.carrier_from_solid, solid.body, solid.level);
  };
  if (cell.workpiece) add_solid(*cell.workpiece);
  for (const Solid& fixture : cell.fixtures) add_solid(fixture);
  for (const Obstacle& one : cell.obstacles) {
    if (one.level) add(mesh_of(one.shape), one.carrier_from_shape, one.body, one.level);
  }
  return surfaces;
}

StageFault found(const Cell& cell, const TargetFault& fault) {
  for (std::size_t body = 0; body < cell.movers.size(); ++body) {
    if (cell.movers[body].body.name != fault.body) continue;
    const std::vector<Target>& targets = cell.movers[body].body.targets;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (targets[i].id == fault.target) return {body, i, fault};
    }
  }
  throw InputError(cell.name, fmt::format("a fault is of target `{}` of body `{}`, which is not there",
                                          fault.target, fault.body));
}

}  // namespace

Stage stage_of(Cell cell) {
  check_cell(cell, cell.name);
  Stage stage;
  stage.cell = std::move(cell);
  const auto add = [&](const Solid& solid) {
    if (!solid.surface->empty()) stage.solids.push_back(ready(stage.cell, solid));
  };
  if (stage.cell.workpiece) add(*stage.cell.workpiece);
  for (const Solid& fixture : stage.cell.fixtures) add(fixture);
  stage.surfaces = surfaces_of(stage.cell);
  for (const TargetFault& fault : stage.cell.faults) stage.faults.push_back(found(stage.cell, fault));
  return stage;
}

StageTarget target_at(const Stage& stage, std::size_t body, std::size_t target, double time_s) {
  StageTarget now{stage.cell.movers[body].body.targets[target], true};
  const Vec3 as_told = now.target.position;
  for (const StageFault& one : stage.faults) {
    if (one.body != body || one.target != target || time_s < one.fault.time_s) continue;
    if (one.fault.kind == FaultKind::FallsOff) now.there = false;
    if (one.fault.kind == FaultKind::Knocked) now.target.position = as_told + one.fault.shift_mm;
  }
  return now;
}

}  // namespace asterism
