// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// What surfaces or points tell of a small motion, split into what they determine and what they leave free: a
/// cylinder leaves its turn and its slide free, a plane three motions.
struct Determined {
  Mat6 inverse = Mat6::Zero();    // of the information, on what is determined; zero along the rest
  Mat6 projector = Mat6::Zero();  // onto what is determined
  int degrees = 0;                // of freedom that are
  std::vector<Vec6> free;         // motions (ω, δ at `about`), unit at a distance `reach_mm`
};
/// `information` is of (ω, δ) at some point, `reach_mm` how far the surface reaches from it: motions are
/// compared by how far they move it there. Free is what is known worse than `free_mm`.
[[nodiscard]] Determined determined_by(const Mat6& information, double reach_mm, double free_mm);

/// "a turn about the axis (0.00, 0.00, 1.00) through (10, 0, 0)", "a slide along …": a motion (ω, δ at
/// `about`) in words.
[[nodiscard]] std::string words_of(const Vec6& motion, const Vec3& about, double reach_mm);

}  // namespace asterism
