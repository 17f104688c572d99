// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// A scheme of the paper's Table 9 and what Sections 4.2 and Table 10 say of it.
struct Scheme {
  std::string name;  // S1
  std::vector<Vec3> targets;
  double f1_mm = 0;        // mean distance of the targets to the origin
  double coverage_mm = 0;  // sum of the pair distances; f2 is its negative
  int rank = 0;            // 0 = Front 1 of the five
  double crowding = 0;     // within its front, Eq. 29
};

/// f1 and f2 of Section 4.2 (its pair of objectives, both minimised).
[[nodiscard]] std::array<double, 2> objectives_of(std::span<const Vec3> targets);

/// The five schemes with S4's second target at x = +220.
[[nodiscard]] std::vector<Scheme> schemes_of_table9();

/// Rank and crowding of any five layouts.
[[nodiscard]] std::vector<Scheme> rank_schemes(std::vector<Scheme> schemes);

}  // namespace asterism
