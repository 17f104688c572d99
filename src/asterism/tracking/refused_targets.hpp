// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asterism/tracking/view_matching.hpp"

namespace asterism {

/// The views of a body that were offered to its pose, and which of them it refused.
struct OfferedViews {
  std::span<const TargetView> views;
  std::span<const int> rejected;  // indices into `views`, ascending
};

/// The point (index) that stands where a target may have been knocked to: the only one within
/// `moved_reach_mm` of the target's place whose two centres are free. None where two could be meant.
[[nodiscard]] std::optional<std::size_t> displaced_point(const Vec3& place_in_tracker,
                                                         std::span<const Point> points, const CentreUse& use,
                                                         const ViewOptions& options);

/// Targets of a body that were seen and did not fit its pose, ascending: those with a refused view, and
/// those without any beside whose place a point stands.
[[nodiscard]] std::vector<int> refused_targets(const Body& body, const OfferedViews& offered,
                                               const PoseEstimate& pose, std::span<const Point> points,
                                               const CentreUse& use, const ViewOptions& options);

}  // namespace asterism
