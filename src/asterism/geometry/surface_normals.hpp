// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// The part of a triangle on which a point lies; edges and corners in the triangle's order.
enum class Feature : std::uint8_t { Face, EdgeAB, EdgeBC, EdgeCA, CornerA, CornerB, CornerC };

/// Where a surface faces on each of its features, so that the sign of (point − nearest) · normal is right
/// (Bærentzen & Aanæs, IEEE TVCG 11 (2005) 243): on a face its own normal, on an edge the sum of those of
/// the triangles that share it, at a corner the sum of all around weighted by their angle there. Corners in
/// one place are one, whether or not the triangles name the same vertex. Where the sum cancels (two faces
/// back to back) the triangle's own normal counts. All unit; zero for a triangle without area (less high than
/// 1e-7 of its longest side).
class SurfaceNormals {
 public:
  explicit SurfaceNormals(const TriangleMesh& surface);

  [[nodiscard]] const Vec3& face(std::size_t triangle) const { return faces_[triangle]; }
  [[nodiscard]] Vec3 at(std::size_t triangle, Feature feature) const;

 private:
  std::vector<Vec3> faces_, edges_, corners_;                  // edges and corners not normalised
  std::vector<std::array<std::uint32_t, 6>> edge_and_corner_;  // by triangle: AB BC CA, A B C
};

}  // namespace asterism
