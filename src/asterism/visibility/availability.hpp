// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "asterism/visibility/visibility.hpp"

namespace asterism {

/// Targets that both cameras see, by pose.
[[nodiscard]] std::vector<int> visible_counts(const MotionVisibility& visibility);

/// The fewest over the motion; 0 for no poses.
[[nodiscard]] int fewest_visible(const MotionVisibility& visibility);

/// The first pose in which both cameras see fewer than `needed` targets; none when there is none.
[[nodiscard]] std::optional<std::size_t> first_pose_below(const MotionVisibility& visibility, int needed = 4);

/// The probability that at least `needed` of `visible` targets remain when each is lost with probability q,
/// independently: Σ_{s ≥ needed} C(visible, s) (1 − q)^s q^(visible − s).
[[nodiscard]] double availability(int visible, double loss_probability, int needed = 4);

struct MotionAvailability {
  double mean = 0;   // over the poses: the share of frames in which the body can be told and measured
  double worst = 0;  // of one pose
};
[[nodiscard]] MotionAvailability availability_over(const MotionVisibility& visibility,
                                                   double loss_probability, int needed = 4);

}  // namespace asterism
