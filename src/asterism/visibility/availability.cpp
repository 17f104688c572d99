// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/availability.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "asterism/core/result.hpp"

namespace asterism {

std::vector<int> visible_counts(const MotionVisibility& visibility) {
  std::vector<int> counts;
  for (std::size_t pose = 0; pose < visibility.poses(); ++pose) {
    counts.push_back(std::popcount(visibility.both(pose)));
  }
  return counts;
}

int fewest_visible(const MotionVisibility& visibility) {
  const std::vector<int> counts = visible_counts(visibility);
  return counts.empty() ? 0 : *std::min_element(counts.begin(), counts.end());
}

std::optional<std::size_t> first_pose_below(const MotionVisibility& visibility, int needed) {
  for (std::size_t pose = 0; pose < visibility.poses(); ++pose) {
    if (std::popcount(visibility.both(pose)) < needed) return pose;
  }
  return std::nullopt;
}

double availability(int visible, double loss_probability, int needed) {
  require(visible >= 0, "a count of targets is not negative");
  require(loss_probability >= 0 && loss_probability <= 1, "a probability lies between 0 and 1");
  // Target by target: chance[s] = that s of those asked so far remain. All terms are positive.
  std::vector<double> chance(static_cast<std::size_t>(visible) + 1, 0.0);
  chance[0] = 1;
  for (int target = 0; target < visible; ++target) {
    for (std::size_t s = static_cast<std::size_t>(target) + 1; s > 0; --s) {
      chance[s] = loss_probability * chance[s] + (1 - loss_probability) * chance[s - 1];
    }
    chance[0] *= loss_probability;
  }
  double sum = 0;
  for (int s = std::max(needed, 0); s <= visible; ++s) sum += chance[static_cast<std::size_t>(s)];
  return std::min(sum, 1.0);
}

MotionAvailability availability_over(const MotionVisibility& visibility, double loss_probability,
                                     int needed) {
  if (visibility.poses() == 0) return {};
  std::array<int, kMaxTargets + 1> poses_of_count{};
  for (std::size_t pose = 0; pose < visibility.poses(); ++pose) {
    ++poses_of_count[static_cast<std::size_t>(std::popcount(visibility.both(pose)))];
  }
  MotionAvailability over{0, 1};
  for (std::size_t count = 0; count < poses_of_count.size(); ++count) {
    if (poses_of_count[count] == 0) continue;
    const double here = availability(static_cast<int>(count), loss_probability, needed);
    over.mean += poses_of_count[count] * here;
    over.worst = std::min(over.worst, here);
  }
  over.mean /= static_cast<double>(visibility.poses());
  return over;
}

}  // namespace asterism
