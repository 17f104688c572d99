// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/cell/cell.hpp"
#include "asterism/geometry/ray_scene.hpp"
#include "asterism/geometry/surface_tree.hpp"

namespace asterism {

/// What stands before the scanner whatever the platform does, in the workpiece's frame: the part itself, and
/// apart from it all that moves with it (table, clamps, pipes).
struct ScanScene {
  RayScene part, fixtures;
  SurfaceTree part_surface, fixtures_surface;
};

/// Throws InputError for a cell without workpiece.
[[nodiscard]] ScanScene scan_scene_of(const Cell& cell);

/// All that moves with the part but the part itself, in its frame.
[[nodiscard]] TriangleMesh fixtures_on_part(const Cell& cell);

/// What does not move with the part nor with the scanner, in the tracker's frame, other bodies where they
/// begin.
[[nodiscard]] TriangleMesh surroundings_of(const Cell& cell);

}  // namespace asterism
