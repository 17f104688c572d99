// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/hypervolume.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// Points better than the reference, mirrored: coordinate k is reference − objective, so that all volumes
/// are measured from nought and more is better.
std::vector<double> gains(std::span<const double> objectives, std::size_t m,
                          std::span<const double> reference) {
  std::vector<double> gain;
  gain.reserve(objectives.size());
  for (std::size_t i = 0; i < objectives.size(); i += m) {
    bool better = true;
    for (std::size_t k = 0; k < m; ++k) better &= objectives[i + k] < reference[k];
    for (std::size_t k = 0; better && k < m; ++k) gain.push_back(reference[k] - objectives[i + k]);
  }
  return gain;
}

/// Area of the union of the rectangles from nought to (x, y), which grows as points come.
class GrowingArea {
 public:
  [[nodiscard]] double area() const { return area_; }
  void clear() {
    steps_.clear();
    area_ = 0;
  }
  void add(double x, double y) {
    const auto before = std::ranges::lower_bound(steps_, x, {}, &Step::x);  // x ascends, y descends
    if (before != steps_.end() && before->y >= y) return;
    const double below = before == steps_.end() ? 0 : before->y;  // height already covered left of x
    auto first = before;
    double right = x;
    double height = below;
    while (first != steps_.begin() && std::prev(first)->y <= y) {
      --first;
      area_ += (right - first->x) * (y - height);
      right = first->x;
      height = first->y;
    }
    area_ += (right - (first == steps_.begin() ? 0 : std::prev(first)->x)) * (y - height);
    const auto last = before != steps_.end() && before->x == x ? before + 1 : before;
    if (first == last) {
      steps_.insert(first, {x, y});
    } else {
      *first = {x, y};
      steps_.erase(first + 1, last);
    }
  }

 private:
  struct Step {
    double x, y;
  };
  std::vector<Step> steps_;
  double area_ = 0;
};

/// One workspace for each number of coordinates.
class VolumeOfGains {
 public:
  explicit VolumeOfGains(std::size_t m) : levels_(m + 1) {}

  double operator()(std::span<const double> gain, std::size_t m) {
    if (m == 1) return gain.empty() ? 0 : *std::ranges::max_element(gain);
    if (m == 2) return swept_two(gain);
    if (m == 3) return swept_three(gain);
    return sliced(gain, m);
  }

 private:
  struct Level {
    std::vector<std::uint32_t> order;
    std::vector<double> limited, kept;
  };

  /// Points by descending last coordinate.
  std::span<const std::uint32_t> sorted(std::span<const double> gain, std::size_t m) {
    auto& order = levels_[m].order;
    order.resize(gain.size() / m);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      const double p = gain[a * m + m - 1];
      const double q = gain[b * m + m - 1];
      return p > q || (p == q && a < b);
    });
    return order;
  }

  double swept_two(std::span<const double> gain) {
    double area = 0, reached = 0;
    for (const std::uint32_t i : sorted(gain, 2)) {
      if (gain[2 * i] <= reached) continue;
      area += (gain[2 * i] - reached) * gain[2 * i + 1];
      reached = gain[2 * i];
    }
    return area;
  }

  double swept_three(std::span<const double> gain) {
    area_.clear();
    double volume = 0, height = 0;
    for (const std::uint32_t i : sorted(gain, 3)) {
      volume += area_.area() * (height - gain[3 * i + 2]);
      height = gain[3 * i + 2];
      area_.add(gain[3 * i], gain[3 * i + 1]);
    }
    return volume + area_.area() * height;
  }

  /// From the smallest last coordinate up, each point adds what none of the later ones dominates; those are
  /// higher, so this is a slice as high as the point with a base of one coordinate fewer.
  double sliced(std::span<const double> gain, std::size_t m) {
    const auto order = sorted(gain, m);
    double volume = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const double* point = gain.data() + order[i] * m;
      double base = 1;
      for (std::size_t k = 0; k + 1 < m; ++k) base *= point[k];
      volume += point[m - 1] * (base - (*this)(limited(gain, m, order.first(i), point), m - 1));
    }
    return volume;
  }

  /// The base of the points `who`, cut down to the base of `point`; from four coordinates on without those
  /// that others dominate.
  std::span<const double> limited(std::span<const double> gain, std::size_t m,
                                  std::span<const std::uint32_t> who, const double* point) {
    const std::size_t base = m - 1;
    auto& all = levels_[m].limited;
    all.clear();
    for (const std::uint32_t i : who)
      for (std::size_t k = 0; k < base; ++k) all.push_back(std::min(gain[i * m + k], point[k]));
    if (base <= 3) return all;

    auto& kept = levels_[m].kept;
    kept.clear();
    const auto at_least = [base](const double* a, const double* b) {
      for (std::size_t k = 0; k < base; ++k)
        if (a[k] < b[k]) return false;
      return true;
    };
    for (std::size_t i = 0; i < all.size(); i += base) {
      const double* one = all.data() + i;
      bool dominated = false;
      for (std::size_t j = 0; j < kept.size() && !dominated; j += base)
        dominated = at_least(kept.data() + j, one);
      if (dominated) continue;
      std::size_t end = 0;
      for (std::size_t j = 0; j < kept.size(); j += base) {
        if (at_least(one, kept.data() + j)) continue;
        std::copy_n(kept.data() + j, base, kept.data() + end);
        end += base;
      }
      kept.resize(end);
      kept.insert(kept.end(), one, one + base);
    }
    return kept;
  }

  std::vector<Level> levels_;
  GrowingArea area_;
};

}  // namespace

double hypervolume(std::span<const double> objectives, std::size_t m, std::span<const double> reference) {
  require(m > 0 && objectives.size() % m == 0 && reference.size() == m,
          "objectives are count × m numbers and the reference m");
  return VolumeOfGains(m)(gains(objectives, m, reference), m);
}

}  // namespace asterism
