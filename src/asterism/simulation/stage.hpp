// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/geometry/ray_scene.hpp"
#include "asterism/geometry/slabs.hpp"
#include "asterism/simulation/surface.hpp"

namespace asterism {

/// A mesh of the cell, made ready to be asked what it hides; in the frame of what carries it.
struct StageSolid {
  int carrier = -1;  // a mover; −1 = stands in `tracker`
  RayScene tree;
  Slabs slabs;  // they tell what it cannot hide
};

/// A fault with the places of its body and target instead of their names.
struct StageFault {
  std::size_t body = 0, target = 0;
  TargetFault fault;
};

/// A cell made ready for simulation once, to be looked at from any camera at any moment: what does not change
/// from frame to frame is worked out here. Looking is const and may be done by many threads.
struct Stage {
  Cell cell;
  std::vector<StageSolid> solids;  // the workpiece first, then fixtures; simple obstacles are asked exactly
  std::vector<DrawnSurface> surfaces;  // of whatever has a level of its own, simple obstacles too
  std::vector<StageFault> faults;
};

/// Throws InputError when the cell is not sound (check_cell) or a fault is of a target that is not there.
[[nodiscard]] Stage stage_of(Cell cell);

/// One target at one moment, in its body's frame, after what befell it until then.
struct StageTarget {
  Target target;
  bool there = true;  // false: it has fallen off
};
[[nodiscard]] StageTarget target_at(const Stage& stage, std::size_t body, std::size_t target, double time_s);

}  // namespace asterism
