// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "asterism/cell/scan_task.hpp"
#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// A place of the part's surface that stands for the area around it.
struct SurfaceSample {
  Vec3 at;      // mm, in the workpiece's frame
  Vec3 normal;  // unit, outwards
  std::uint32_t triangle = 0;
  double area_mm2 = 0;
  double weight = 1;  // of the region it lies in

  [[nodiscard]] double worth() const { return weight * area_mm2; }
};

/// `count` places spread evenly by area: the surface is cut into as many strips of equal area in the order of
/// its triangles along a space-filling curve, and each gets one at random, so no part of it is left out by
/// chance. The later of two regions that hold a place counts. Throws InputError for a surface without area.
[[nodiscard]] std::vector<SurfaceSample> sample_surface(const TriangleMesh& surface, std::size_t count,
                                                        std::span<const ScanRegion> regions,
                                                        std::uint64_t seed);

}  // namespace asterism
