// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "asterism/core/options.hpp"
#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// A solid told by its surface: the workpiece, a fixture, the scanner's housing. It moves with a body of the
/// cell or stands in the tracker's frame.
struct Solid {
  std::string name;
  std::shared_ptr<const TriangleMesh> surface;  // mm, in the solid's own frame
  std::string body;                             // what it moves with; empty = fixed in `tracker`
  RigidMotion carrier_from_solid;               // carrier = that body, or the tracker
  std::optional<double> level;  // brightness as a share of full scale; none = as the background
};

/// A conical engine casing, made of numbers instead of a file: a wall of revolution about z, open at both
/// ends, flanged below and above, with cylindrical bosses around its outside. The paper's part (LEDGER 2.6):
/// its outer radius grows from 453.2 mm by 0.1208 a millimetre of height.
struct CasingShape {
  double bottom_radius_mm = 453.2;  // outer
  double top_radius_mm = 520.8;
  double height_mm = 560;
  double wall_mm = 12;
  double flange_width_mm = 40;   // beyond the outer wall; 0 = no flanges
  double flange_height_mm = 20;  // thickness
  int bosses = 12;               // evenly around, halfway up
  double boss_radius_mm = 35;
  double boss_height_mm = 30;  // how far they stand out
  int sides = 180;             // of the polygon that stands for a circle
};
void describe(CasingShape& shape, OptionVisitor& visit);

/// The wall and each boss are closed surfaces of their own; bosses reach into the wall.
[[nodiscard]] TriangleMesh mesh_of(const CasingShape& casing);

}  // namespace asterism
