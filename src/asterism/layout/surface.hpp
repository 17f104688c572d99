// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "asterism/cell/layout_task.hpp"
#include "asterism/cell/shape_distance.hpp"
#include "asterism/core/random.hpp"

namespace asterism {

/// A place for a target, in the frame of the body; mm.
struct Place {
  Vec3 position_mm;
  Vec3 normal;            // unit; where a target on it faces
  std::size_t patch = 0;  // of the surface
};

/// The place of the patches that is nearest to a point, keep-outs left aside.
[[nodiscard]] Place nearest_place(const DeployableSurface& surface, const Vec3& point);

/// Two directions along a surface that faces this way, at right angles.
[[nodiscard]] std::array<Vec3, 2> along_surface(const Vec3& normal);

/// Is a point inside a keep-out, or nearer to one than `clearance_mm` (half a target)?
[[nodiscard]] bool kept_out(const DeployableSurface& surface, const Vec3& point, double clearance_mm);

/// The same as nearest_place, but out of the keep-outs. Where the nearest place lies in one, the way out is
/// sought in 16 directions of the patch and followed to its edge, so it is near but not always the nearest.
/// Empty when none is found.
[[nodiscard]] std::optional<Place> nearest_allowed_place(const DeployableSurface& surface, const Vec3& point,
                                                         double clearance_mm);

/// Area of a patch, mm²; of a cylinder's room that of its floor.
[[nodiscard]] double area_mm2(const Patch& patch);

/// Uniform over the area of all patches (over the volume of a cylinder's room), outside the keep-outs.
/// Empty when a thousand tries found only keep-outs.
[[nodiscard]] std::optional<Place> random_place(const DeployableSurface& surface, double clearance_mm,
                                                RandomStream& random);

/// Corners of a box along the axes that holds all patches.
struct Bounds {
  Vec3 lowest, highest;
};
[[nodiscard]] Bounds bounds_of(const DeployableSurface& surface);

}  // namespace asterism
