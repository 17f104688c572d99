// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asterism/cell/layout_task.hpp"
#include "asterism/visibility/occlusion.hpp"

namespace asterism {

/// From where on a surface which sights are hidden, worked out once for a search that asks of many layouts:
/// each patch gets a grid of places, and each place a bit for every pose and camera, by Occlusion's rays.
///
/// A target between places counts as hidden where any of them is: up to a step before the shadow's edge. So a
/// foot that is set a few mm aside is still seen, and a layout that is good by this table is as good or
/// better when every ray is asked, but for shadows narrower than a step that fall between the places
/// (measured in benchmarks/visibility_bench.cpp).
class Shadows {
 public:
  /// As many places as make `places` at most, no nearer than half a target. Poses as Occlusion has them.
  Shadows(const DeployableSurface& surface, double diameter_mm, const Occlusion& occlusion,
          std::size_t carrier, std::span<const std::vector<RigidMotion>> poses, std::size_t places);

  /// Nothing hides anything.
  [[nodiscard]] bool empty() const { return hidden_.empty(); }
  [[nodiscard]] double step_mm() const { return step_mm_; }
  [[nodiscard]] std::size_t places() const { return places_; }

  /// What of `seen` is left. Targets stand on the surface.
  [[nodiscard]] MotionVisibility unhidden_of(MotionVisibility seen, std::span<const Target> targets) const;

 private:
  struct Grid {
    DeployableSurface patch;  // that one alone
    Vec3 low, size;           // mm along the patch's own coordinates
    std::array<std::size_t, 3> count;
    std::size_t first;  // of its places among all
  };
  [[nodiscard]] static Grid grid_of(const NamedPatch& patch, double step_mm);
  /// Corners of the simplex of the grid that a point lies in.
  [[nodiscard]] static std::array<std::size_t, 4> places_around(const Grid& grid, const Vec3& point);
  [[nodiscard]] Target target_at(const Grid& grid, std::size_t place, double diameter_mm) const;

  DeployableSurface surface_;
  std::vector<Grid> grids_;  // by patch
  double step_mm_ = 0;
  std::size_t places_ = 0, words_ = 0;  // words of 64 sights a place
  std::vector<std::uint64_t> hidden_;   // by place; bit 2 · pose + side
};

}  // namespace asterism
