// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// The point of a surface that is nearest to another point.
struct NearestOnSurface {
  double signed_distance_mm;  // positive outside
  std::size_t triangle;
  Vec3 at;
  Vec3 normal;  // unit, outwards: of the triangle; on an edge or at a vertex the angle-weighted mean
};

/// A surface made ready to be asked how far points lie from it. The sign comes from the angle-weighted
/// pseudo-normal of the face, edge or vertex that is nearest (Bærentzen & Aanæs, IEEE TVCG 11 (2005) 243):
/// right at edges too, where that of any one triangle is not. Where the surface is open there is no outside;
/// the sign then says on which side of its nearest feature a point lies. Embree, in single precision, says
/// which triangles may be the nearest; which one is, and how far, is decided in double precision. Triangles
/// without area are left out. Asking is const and may be done by many threads.
class SurfaceTree {
 public:
  explicit SurfaceTree(const TriangleMesh& surface);

  /// None farther away than `within_mm`, or when the surface is empty.
  [[nodiscard]] std::optional<NearestOnSurface> nearest(
      const Vec3& point, double within_mm = std::numeric_limits<double>::infinity()) const;

  /// Signed distances of many points, in parallel; NaN beyond `within_mm`.
  [[nodiscard]] std::vector<double> signed_distances(
      std::span<const Vec3> points, double within_mm = std::numeric_limits<double>::infinity()) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace asterism
