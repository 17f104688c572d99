// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// Where a way first meets a surface.
struct RayHit {
  std::size_t surface;   // in the order in which they were given
  std::size_t triangle;  // of that surface
  double share;          // of the way: 0 at its begin, 1 at its end
  Vec3 normal;           // unit, outwards by the triangle's sense
};

/// Surfaces made ready to be asked what lies between two points; a thin wrapper of Intel Embree (its robust
/// mode, so no ray slips through an edge). Coordinates are rounded to single precision, 0.0002 mm at 3 m;
/// what must not depend on one ray is asked by several. Asking is const and may be done by many threads; the
/// answer is the same on any number of them. Embree takes the instructions of the processor it runs on, so
/// what lies within that rounding of an edge may be answered otherwise on another kind of processor.
class RayScene {
 public:
  /// All in one frame. Empty surfaces are allowed and never hit.
  explicit RayScene(std::span<const TriangleMesh> surfaces);
  explicit RayScene(const TriangleMesh& surface) : RayScene(std::span(&surface, 1)) {}

  [[nodiscard]] bool empty() const { return triangles_ == 0; }
  [[nodiscard]] std::size_t triangles() const { return triangles_; }

  /// Does anything lie between the two points?
  [[nodiscard]] bool blocked(const Vec3& from, const Vec3& to) const;

  /// The same of many ways to one point; `out[i]` becomes 1 or 0. Fastest when neighbours in `from` are
  /// neighbours in space.
  void blocked(std::span<const Vec3> from, const Vec3& to, std::span<std::uint8_t> out) const;

  /// The same of a bundle, ways to one point that begin so near to each other that they mostly meet the same
  /// triangles, as lines of sight from one disc: the first by itself, then sixteen at once, twice as fast.
  /// What `marks` has as 1 is not asked again; what is found blocked becomes 1. Stops when more than `most`
  /// are marked. Returns how many are.
  std::size_t block_bundle(std::span<const Vec3> from, const Vec3& to, std::size_t most,
                           std::span<std::uint8_t> marks) const;

  [[nodiscard]] std::optional<RayHit> first_hit(const Vec3& from, const Vec3& to) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
  std::size_t triangles_ = 0;
};

/// The same question in double precision over all triangles, one by one (Möller & Trumbore 1997): slow and
/// right; for tests and for what is too near an edge to call.
[[nodiscard]] bool blocked_exactly(const TriangleMesh& surface, const Vec3& from, const Vec3& to);

}  // namespace asterism
