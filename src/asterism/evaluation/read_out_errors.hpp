// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/cell/cell.hpp"

namespace asterism {

/// A pose without targets: what the platform says of itself when a picture is taken, by the error model of
/// cell/platform.hpp (Figs. 21 and 22 of the paper, "without targets"). An assumption: the paper does not
/// tell how it had that pose.
struct ReadOutErrors {
  std::vector<double> rotation_deg;        // by frame
  std::vector<double> translation_mm;      // at the platform's pivot
  std::vector<std::vector<double>> at_mm;  // by point, then frame
};

/// Errors of the read-out at each frame's time; `points` in the platform's frame. Throws InputError when the
/// cell has no platform.
[[nodiscard]] ReadOutErrors read_out_errors(const Cell& cell, std::span<const Vec3> points,
                                            std::uint64_t seed);

}  // namespace asterism
