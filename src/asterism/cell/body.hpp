// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// A round target fixed to a body.
struct Target {
  std::string id;
  Vec3 position;               // mm, in the body's frame
  std::optional<Vec3> normal;  // unit; where the disc faces
  std::optional<double> diameter_mm;
  std::optional<Mat3> covariance;  // mm², of the position

  /// Radius for the image model: without a normal the eccentricity cannot be told, so 0.
  [[nodiscard]] double imaged_radius_mm() const { return normal && diameter_mm ? 0.5 * *diameter_mm : 0.0; }
};

/// Targets that move together: the platform, the scanner, a probe.
struct Body {
  std::string name;
  std::vector<Target> targets;
};

/// Where the targets are, in the body's frame, mm.
[[nodiscard]] std::vector<Vec3> positions_of(std::span<const Target> targets);

/// Throws InputError for: no targets, a name or id given twice, a number that is not finite, a normal of
/// length zero, a diameter not positive, two targets at one place.
void check_bodies(const std::vector<Body>& bodies, const std::string& where);

}  // namespace asterism
