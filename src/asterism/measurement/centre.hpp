// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "asterism/geometry/ellipse.hpp"

namespace asterism {

/// What is unusual about a centre; a set of bits.
enum CentreFlag : std::uint32_t {
  kSaturated = 1,  // part of the disc is at the sensor's ceiling
  kOccluded = 2,   // its outline is no ellipse: something covers part of it
  kBorder = 4,     // touches the image's edge
  kTouching = 8,   // a neighbour's light reaches into its window
  kSmall = 16,     // too small to fit the edge's blur; blur held
  kCoarse = 32,    // the edge fit did not come off; centre of gravity instead, covariance widened
};

/// "saturated|occluded"; empty for none. And back; throws InputError for an unknown word.
[[nodiscard]] std::string text_of_flags(std::uint32_t flags);
[[nodiscard]] std::uint32_t flags_of_text(const std::string& text);

/// The centre of a round target's elliptical image, and how well it is known.
struct Centre {
  Ellipse ellipse;                     // px; not corrected for perspective
  Mat2 covariance = Mat2::Identity();  // px², of the ellipse's centre
  double amplitude = 0;                // grey levels above the background; negative for dark discs
  double background = 0;
  std::uint32_t flags = 0;

  [[nodiscard]] const Vec2& px() const { return ellipse.centre; }
};

}  // namespace asterism
