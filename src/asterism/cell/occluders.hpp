// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/cell/cell.hpp"

namespace asterism {

/// Something that can stand between a target and a camera, as triangles in the frame of what carries it.
struct Occluder {
  std::string name;
  int carrier = -1;      // index into the cell's movers; −1 = stands in `tracker`
  TriangleMesh surface;  // mm, in the carrier's frame
};

/// Workpiece, fixtures and simple obstacles of a cell. Round shapes become polygons of 96 sides whose corners
/// lie on the circle: a cylinder of 500 mm radius is up to 0.27 mm too thin.
[[nodiscard]] std::vector<Occluder> occluders_of(const Cell& cell);

/// A simple shape as a closed surface.
[[nodiscard]] TriangleMesh mesh_of(const Shape& shape);

/// Where every mover is at a moment: tracker_from_body, in the cell's order.
[[nodiscard]] std::vector<RigidMotion> poses_at(const Cell& cell, double time_s);

/// Which mover has this name; −1 when none.
[[nodiscard]] int mover_index(const Cell& cell, const std::string& body);

}  // namespace asterism
