// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "asterism/cell/cell_checks.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/mesh_queries.hpp"

namespace asterism {
namespace {

constexpr double kSmallestMm = 5, kLargestMm = 50e3;  // of a box's diagonal
constexpr double kSunkMm = 0.1;                       // a target's own thickness

struct Extent {
  Vec3 lowest, highest;
  [[nodiscard]] bool holds(const Vec3& place) const {
    return (place.array() >= lowest.array()).all() && (place.array() <= highest.array()).all();
  }
};

Extent extent_of(const TriangleMesh& mesh) {
  Extent extent{mesh.corner(0, 0), mesh.corner(0, 0)};
  for (const Vec3& vertex : mesh.vertices) {
    extent.lowest = extent.lowest.cwiseMin(vertex);
    extent.highest = extent.highest.cwiseMax(vertex);
  }
  return extent;
}

Extent checked_extent(const Solid& solid, const std::string& here) {
  if (!solid.surface || solid.surface->empty()) throw InputError(here, "its surface has no triangles");
  for (const Vec3& vertex : solid.surface->vertices) {
    if (!vertex.allFinite()) throw InputError(here, "a corner of its surface is not a finite number");
  }
  Extent extent = extent_of(*solid.surface);
  const double diagonal = (extent.highest - extent.lowest).norm();
  if (diagonal < kSmallestMm || diagonal > kLargestMm) {
    throw InputError(here,
                     fmt::format("it is {:.3g} mm from corner to corner; a solid of a cell is {} mm to {} mm",
                                 diagonal, kSmallestMm, kLargestMm));
  }
  return extent;
}

/// Inside a closed surface the winding number is whole and not zero; at an open one it says nothing.
void check_target(const Target& target, const Solid& solid, const Extent& extent, const std::string& here) {
  const Vec3 place = solid.carrier_from_solid.inverse() * target.position;
  if (!extent.holds(place)) return;
  const double around = winding_number(*solid.surface, place);
  if (std::abs(around) < 0.5 || std::abs(around - std::round(around)) > 1e-6) return;
  const double depth = distance_to(*solid.surface, place);
  if (depth <= kSunkMm) return;
  throw InputError(here, fmt::format("target `{}` of body `{}` is inside it, {:.1f} mm deep; a target must "
                                     "stand on its surface or clear of it",
                                     target.id, solid.body, depth));
}

void check_solid(const Solid& solid, const Cell& cell, const std::string& here) {
  const Extent extent = checked_extent(solid, here);
  if (solid.body.empty()) return;
  check_carrier(solid.body, cell, here, "it moves with");
  for (const Mover& mover : cell.movers) {
    if (mover.body.name != solid.body) continue;
    for (const Target& target : mover.body.targets) check_target(target, solid, extent, here);
  }
}

void remark_on(const Solid& solid, std::vector<std::string>& remarks) {
  const MeshFacts facts = facts_of(*solid.surface);
  const auto add = [&](std::size_t count, const char* what, const char* so) {
    if (count > 0) remarks.push_back(fmt::format("`{}`: {}: {}; {}", solid.name, what, count, so));
  };
  add(facts.boundary_edges, "the surface is open, edges of one triangle alone",
      "it hides targets as it is, but what is inside it cannot be told");
  add(facts.non_manifold_edges, "the surface is not manifold, edges of more than two triangles",
      "it hides targets as it is");
  add(facts.flipped_edges, "triangles face different ways, edges between such",
      "it hides targets as it is, but its outside cannot be told");
  add(facts.degenerate, "triangles without area", "they hide nothing");
}

}  // namespace

void check_solids(const Cell& cell, const std::string& where) {
  if (cell.workpiece) {
    check_solid(*cell.workpiece, cell, fmt::format("{}: workpiece `{}`", where, cell.workpiece->name));
  }
  for (const Solid& fixture : cell.fixtures) {
    check_solid(fixture, cell, fmt::format("{}: fixture `{}`", where, fixture.name));
  }
}

std::vector<std::string> remarks_on(const Cell& cell) {
  std::vector<std::string> remarks;
  if (cell.workpiece) remark_on(*cell.workpiece, remarks);
  for (const Solid& fixture : cell.fixtures) remark_on(fixture, remarks);
  return remarks;
}

}  // namespace asterism
