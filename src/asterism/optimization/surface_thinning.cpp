// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/surface_thinning.hpp"

#include <algorithm>
#include <tuple>

#include "asterism/core/result.hpp"
#include "asterism/optimization/hypervolume.hpp"

namespace asterism {

std::span<const std::uint32_t> SurfaceThinning::operator()(std::span<const double> front, std::size_t keep,
                                                           std::span<const double> reference) {
  const std::size_t count = front.size() / 3;
  require(reference.size() == 3 && keep <= count,
          "a front's points have three coordinates and enough are there");
  reference_ = reference;
  points_.clear();
  for (std::uint32_t i = 0; i < count; ++i)
    points_.push_back({front[3 * i], front[3 * i + 1], front[3 * i + 2], i});
  std::ranges::sort(points_, {}, [](const Point& p) { return std::tuple(p.z, p.x, p.y, p.at); });
  bounds_.clear();
  if (keep < count) {
    const auto shares = hypervolume_contributions(front, 3, reference);
    for (const Point& point : points_) bounds_.push_back(shares[point.at]);
  }
  fresh_.assign(count, 1);

  while (points_.size() > keep) {
    const auto least = std::ranges::min_element(bounds_) - bounds_.begin();
    const auto at = static_cast<std::size_t>(least);
    if (fresh_[at] == 0) {
      bounds_[at] = share(at);
      fresh_[at] = 1;
      continue;
    }
    static_cast<void>(share(at));
    for (const std::uint32_t neighbour : neighbours_) fresh_[neighbour] = 0;
    points_.erase(points_.begin() + least);
    bounds_.erase(bounds_.begin() + least);
    fresh_.erase(fresh_.begin() + least);
  }
  kept_.clear();
  for (const Point& point : points_) kept_.push_back(point.at);
  std::ranges::sort(kept_);
  return kept_;
}

/// Volume that only this point dominates: a plane rises through the box between it and the reference, in
/// which those below it and those it has passed cover ever more. Those who bound this volume, and with whom
/// alone the point may share another, are listed as its neighbours.
double SurfaceThinning::share(std::size_t of) {
  const Point point = points_[of];
  neighbours_.clear();
  if (point.x >= reference_[0] || point.y >= reference_[1] || point.z >= reference_[2]) return 0;
  covered_.clear();
  const auto cover_by = [&](std::size_t i) {
    return cover(
        {std::max(point.x, points_[i].x), std::max(point.y, points_[i].y), static_cast<std::uint32_t>(i)});
  };
  for (std::size_t i = 0; i < of; ++i) cover_by(i);
  for (const Step& step : covered_) neighbours_.push_back(step.by);
  double area = free_area(point);
  double volume = 0;
  double height = point.z;
  for (std::size_t i = of + 1; i < points_.size() && area > 0; ++i) {
    if (!cover_by(i)) continue;
    neighbours_.push_back(static_cast<std::uint32_t>(i));
    volume += area * (points_[i].z - height);
    height = points_[i].z;
    area = free_area(point);
  }
  return volume + area * (std::max(reference_[2], height) - height);
}

/// Covers what is at least the step; false if it was covered already or lies beyond the reference.
bool SurfaceThinning::cover(const Step& step) {
  if (step.x >= reference_[0] || step.y >= reference_[1]) return false;
  std::size_t first = 0;
  while (first < covered_.size() && covered_[first].x < step.x) ++first;
  if (first > 0 && covered_[first - 1].y <= step.y) return false;
  if (first < covered_.size() && covered_[first].x == step.x && covered_[first].y <= step.y) return false;
  std::size_t last = first;
  while (last < covered_.size() && covered_[last].y >= step.y) ++last;
  const auto begin = covered_.begin() + static_cast<std::ptrdiff_t>(first);
  if (first == last) {
    covered_.insert(begin, step);
  } else {
    *begin = step;
    covered_.erase(begin + 1, covered_.begin() + static_cast<std::ptrdiff_t>(last));
  }
  return true;
}

double SurfaceThinning::free_area(const Point& point) const {
  double area = 0;
  double left = point.x;
  double top = reference_[1];
  for (const Step& step : covered_) {
    area += (step.x - left) * (top - point.y);
    left = step.x;
    top = step.y;
  }
  return area + (reference_[0] - left) * (top - point.y);
}

}  // namespace asterism
