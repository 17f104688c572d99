// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// Simple solids, all convex, each in a frame of its own; lengths in mm.

/// Centred on the origin, edges along the axes.
struct Box {
  Vec3 size_mm = Vec3::Ones();
};

/// All that is within the radius of the line between two points; a ball when they are one.
struct Capsule {
  Vec3 from_mm = Vec3::Zero();
  Vec3 to_mm = Vec3::Zero();
  double radius_mm = 1;
};

/// A truncated cone along +z from z = 0, closed at both ends; a cylinder when the radii are equal.
struct Frustum {
  double bottom_radius_mm = 1;
  double top_radius_mm = 1;
  double height_mm = 1;
};

using Shape = std::variant<Box, Capsule, Frustum>;

/// Are its sizes finite and positive?
[[nodiscard]] bool has_extent(const Shape& shape);

/// A solid that stands in the way: the part, a flange, a cable, the scanner's housing. It moves with a
/// body of the cell or stands in the tracker's frame.
struct Obstacle {
  std::string name;
  Shape shape;
  std::string body;                // what it moves with; empty = fixed in `tracker`
  RigidMotion carrier_from_shape;  // carrier = that body, or the tracker
  std::optional<double> level;     // brightness as a share of full scale; none = as the background
};

}  // namespace asterism
