// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/refused_targets.hpp"

#include <algorithm>

namespace asterism {

std::optional<std::size_t> displaced_point(const Vec3& place_in_tracker, std::span<const Point> points,
                                           const CentreUse& use, const ViewOptions& options) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& point = points[i];
    if ((point.in_tracker - place_in_tracker).norm() > options.moved_reach_mm) continue;
    if (point.left < 0 || point.right < 0) continue;
    if (use.left[static_cast<std::size_t>(point.left)] != 0) continue;
    if (use.right[static_cast<std::size_t>(point.right)] != 0) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

std::vector<int> refused_targets(const Body& body, const OfferedViews& offered, const PoseEstimate& pose,
                                 std::span<const Point> points, const CentreUse& use,
                                 const ViewOptions& options) {
  std::vector<char> has_view(body.targets.size(), 0), refused(body.targets.size(), 0);
  for (const TargetView& view : offered.views) has_view[static_cast<std::size_t>(view.target)] = 1;
  for (const int index : offered.rejected) {
    refused[static_cast<std::size_t>(offered.views[static_cast<std::size_t>(index)].target)] = 1;
  }
  std::vector<int> targets;
  for (std::size_t target = 0; target < body.targets.size(); ++target) {
    const Vec3 place = pose.tracker_from_body * body.targets[target].position;
    const bool displaced = has_view[target] == 0 && displaced_point(place, points, use, options);
    if (refused[target] != 0 || displaced) targets.push_back(static_cast<int>(target));
  }
  return targets;
}

}  // namespace asterism
