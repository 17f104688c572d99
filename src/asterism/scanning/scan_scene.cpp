// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/scan_scene.hpp"

#include "asterism/cell/occluders.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

int scanner_carrier(const Cell& cell) { return cell.scanner ? mover_index(cell, cell.scanner->body) : -1; }

}  // namespace

TriangleMesh fixtures_on_part(const Cell& cell) {
  const int carrier = mover_index(cell, cell.workpiece->body);
  const RigidMotion workpiece_from_carrier = cell.workpiece->carrier_from_solid.inverse();
  TriangleMesh all;
  const std::vector<Occluder> occluders = occluders_of(cell);
  for (std::size_t i = 1; i < occluders.size(); ++i) {  // the first is the workpiece
    if (occluders[i].carrier == carrier) append(all, moved(occluders[i].surface, workpiece_from_carrier));
  }
  return all;
}

ScanScene scan_scene_of(const Cell& cell) {
  if (!cell.workpiece) throw InputError("the cell has no [workpiece]; there is nothing to scan");
  const TriangleMesh fixtures = fixtures_on_part(cell);
  return {RayScene(*cell.workpiece->surface), RayScene(fixtures), SurfaceTree(*cell.workpiece->surface),
          SurfaceTree(fixtures)};
}

TriangleMesh surroundings_of(const Cell& cell) {
  const int part = cell.workpiece ? mover_index(cell, cell.workpiece->body) : -1;
  const std::vector<RigidMotion> poses = poses_at(cell, 0);
  TriangleMesh all;
  for (const Occluder& occluder : occluders_of(cell)) {
    const int carrier = occluder.carrier;
    if (carrier == part || (carrier >= 0 && carrier == scanner_carrier(cell))) continue;
    append(all, carrier < 0 ? occluder.surface
                            : moved(occluder.surface, poses[static_cast<std::size_t>(carrier)]));
  }
  return all;
}

}  // namespace asterism
