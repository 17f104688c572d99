// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>
#include <tuple>

#include "asterism/core/result.hpp"
#include "asterism/optimization/hypervolume.hpp"
#include "asterism/optimization/lexicographic_order.hpp"

namespace asterism {
namespace {

std::vector<double> contributions_of_two(std::span<const double> objectives,
                                         std::span<const double> reference) {
  LexicographicOrder sort;
  std::vector<double> contribution(objectives.size() / 2, 0.0);
  std::vector<std::uint32_t> front;
  for (const std::uint32_t i : sort(objectives, 2))
    if (objectives[2 * i] < reference[0] && objectives[2 * i + 1] < reference[1]) front.push_back(i);
  for (std::size_t at = 0; at < front.size(); ++at) {
    const double* point = objectives.data() + 2 * front[at];
    const double right = at + 1 < front.size() ? objectives[2 * front[at + 1]] : reference[0];
    const double top = at > 0 ? objectives[2 * front[at - 1] + 1] : reference[1];
    require(top >= point[1], "the points are one front");
    contribution[front[at]] = (right - point[0]) * (top - point[1]);
  }
  return contribution;
}

/// Sweeps a plane up the third objective. In it the points met so far make a staircase, and each of its
/// points owns the area that nobody else dominates, kept as strips from left to right, the highest first.
class SweptContributions {
 public:
  SweptContributions(std::span<const double> objectives, std::span<const double> reference)
      : objectives_(objectives), reference_(reference), owned_(objectives.size() / 3) {}

  std::vector<double> operator()() {
    for (const std::uint32_t i : by_height())
      if (x(i) < reference_[0] && y(i) < reference_[1] && z(i) < reference_[2]) meet(i);
    for (const std::uint32_t i : stairs_) settle(i, reference_[2]);
    std::vector<double> volume;
    for (const Owned& owned : owned_) volume.push_back(std::max(0.0, owned.volume));
    return volume;
  }

 private:
  struct Strip {
    double right, top;
  };
  struct Owned {
    std::vector<Strip> strips;
    std::size_t first = 0;  // strips before it are gone
    double area = 0, since = 0, volume = 0;
  };

  [[nodiscard]] double x(std::uint32_t i) const { return objectives_[3 * i]; }
  [[nodiscard]] double y(std::uint32_t i) const { return objectives_[3 * i + 1]; }
  [[nodiscard]] double z(std::uint32_t i) const { return objectives_[3 * i + 2]; }

  [[nodiscard]] std::vector<std::uint32_t> by_height() const {
    std::vector<std::uint32_t> order(owned_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::tuple(z(i), x(i), y(i), i); });
    return order;
  }

  /// Books the volume a point has owned up to `height`.
  void settle(std::uint32_t i, double height) {
    owned_[i].volume += owned_[i].area * (height - owned_[i].since);
    owned_[i].since = height;
  }

  void meet(std::uint32_t i) {
    const auto first = std::ranges::lower_bound(stairs_, x(i), {}, [&](std::uint32_t s) { return x(s); });
    auto last = first;
    while (last != stairs_.end() && y(*last) >= y(i)) ++last;
    if (last != first &&
        std::equal(&objectives_[3 * *first], &objectives_[3 * *first] + 3, &objectives_[3 * i])) {
      // A copy: neither owns anything, now or later.
      settle(*first, z(i));
      owned_[*first].strips.clear();
      owned_[*first].first = 0;
      owned_[*first].area = 0;
      return;
    }
    const bool has_left = first != stairs_.begin();
    require((!has_left || y(*std::prev(first)) > y(i)) && (last == stairs_.end() || x(*last) > x(i)),
            "the points are one front");
    take_area(i, std::span(first, last), has_left ? y(*std::prev(first)) : reference_[1],
              last != stairs_.end() ? x(*last) : reference_[0]);
    if (has_left) cut_right(*std::prev(first), i);
    if (last != stairs_.end()) cut_top(*last, i);
    for (auto covered = first; covered != last; ++covered) settle(*covered, z(i));
    if (first == last) {
      stairs_.insert(first, i);
    } else {
      *first = i;
      stairs_.erase(first + 1, last);
    }
  }

  /// What lies between the new point and the staircase is its own.
  void take_area(std::uint32_t i, std::span<const std::uint32_t> covered, double top, double right) {
    Owned& owned = owned_[i];
    owned.since = z(i);
    double left = x(i);
    const auto add = [&](double end) {
      if (end > left) owned.strips.push_back({end, top});
      owned.area += (end - left) * (top - y(i));
      left = end;
    };
    for (const std::uint32_t step : covered) {
      add(x(step));
      top = y(step);
    }
    add(right);
  }

  /// Point i has come to the right and below: what reaches beyond its left edge is shared.
  void cut_right(std::uint32_t whose, std::uint32_t i) {
    settle(whose, z(i));
    Owned& owned = owned_[whose];
    while (owned.strips.size() > owned.first && owned.strips.back().right > x(i)) {
      Strip& strip = owned.strips.back();
      const double left =
          owned.strips.size() - 1 > owned.first ? owned.strips[owned.strips.size() - 2].right : x(whose);
      const double height = strip.top - y(whose);
      owned.area -= (strip.right - std::max(left, x(i))) * height;
      if (left < x(i)) {
        strip.right = x(i);
        break;
      }
      owned.strips.pop_back();
    }
  }

  /// Point i has come to the left and above: what reaches above its lower edge is shared.
  void cut_top(std::uint32_t whose, std::uint32_t i) {
    settle(whose, z(i));
    Owned& owned = owned_[whose];
    double left = x(whose);
    bool cut = false;
    while (owned.first < owned.strips.size() && owned.strips[owned.first].top > y(i)) {
      const Strip& strip = owned.strips[owned.first++];
      owned.area -= (strip.right - left) * (strip.top - y(i));
      left = strip.right;
      cut = true;
    }
    if (cut) owned.strips[--owned.first] = {left, y(i)};
  }

  std::span<const double> objectives_, reference_;
  std::vector<Owned> owned_;
  std::vector<std::uint32_t> stairs_;  // x ascending, y descending
};

}  // namespace

std::vector<double> hypervolume_contributions(std::span<const double> objectives, std::size_t m,
                                              std::span<const double> reference) {
  require(m == 2 || m == 3, "contributions are known for two and three objectives");
  require(objectives.size() % m == 0 && reference.size() == m,
          "objectives are count × m numbers and the reference m");
  if (m == 2) return contributions_of_two(objectives, reference);
  return SweptContributions(objectives, reference)();
}

}  // namespace asterism
