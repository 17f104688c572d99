// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "asterism/cell/cell.hpp"

namespace asterism {

/// Whose pose a cell's verification is about, and at which of its points accuracy is told: always the
/// centroid of its targets and its origin (O_p of the paper), then the points that are asked for.
struct VerifiedBody {
  static constexpr std::size_t kCentroid = 0, kOrigin = 1, kFirstNamed = 2;

  std::size_t mover = 0;
  std::vector<WorkPoint> points;  // in the body's frame

  [[nodiscard]] bool has_named() const { return points.size() > kFirstNamed; }
};

/// The body: verification's, else the platform's, else the first. The points: verification's, else the
/// layout task's where it is about this body, else the corners of the part's box. Throws InputError when the
/// cell has no such body.
[[nodiscard]] VerifiedBody verification_of(const Cell& cell);

/// Corners of the box around the part, along the part's own axes, in the frame of what carries it.
[[nodiscard]] std::vector<WorkPoint> corners_of_part(const Solid& part);

}  // namespace asterism
