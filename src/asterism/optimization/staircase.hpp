// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <vector>

namespace asterism {

/// The non-dominated among points of the plane, both coordinates minimised: a staircase, x ascending and y
/// descending. A sorted vector, which is quickest as long as it is short, and a tree beyond that.
class Staircase {
 public:
  void clear(std::size_t /*coordinates*/ = 2) {
    steps_.clear();
    tall_.clear();
  }

  /// Whether a point of the staircase is at most as great in both coordinates.
  [[nodiscard]] bool covers(const double* point) const {
    const double x = point[0];
    const double y = point[1];
    if (!tall_.empty()) {
      const auto after = tall_.upper_bound(x);
      return after != tall_.begin() && std::prev(after)->second <= y;
    }
    const Step* base = steps_.data();
    std::size_t length = steps_.size();
    if (length == 0) return false;
    while (length > 1) {
      const std::size_t half = length / 2;
      base += half & -static_cast<std::size_t>(base[half].x <= x);
      length -= half;
    }
    return base->x <= x && base->y <= y;
  }

  /// Adds a point that is not covered and drops those it covers.
  void add(const double* point) {
    const double x = point[0];
    const double y = point[1];
    if (steps_.size() == kTallest) {
      for (const Step& step : steps_) tall_.emplace_hint(tall_.end(), step.x, step.y);
      steps_.clear();
    }
    if (!tall_.empty()) return add_to_tall(x, y);
    const auto first = std::ranges::lower_bound(steps_, x, {}, &Step::x);
    auto last = first;
    while (last != steps_.end() && last->y >= y) ++last;
    if (first == last) {
      steps_.insert(first, {x, y});
    } else {
      *first = {x, y};
      steps_.erase(first + 1, last);
    }
  }

 private:
  static constexpr std::size_t kTallest = 2048;
  struct Step {
    double x, y;
  };

  void add_to_tall(double x, double y) {
    const auto first = tall_.lower_bound(x);
    auto last = first;
    while (last != tall_.end() && last->second >= y) ++last;
    tall_.emplace_hint(tall_.erase(first, last), x, y);
  }

  std::vector<Step> steps_;
  std::map<double, double> tall_;  // in use once it is not empty
};

}  // namespace asterism
