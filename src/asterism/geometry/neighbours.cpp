// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/neighbours.hpp"

#include <algorithm>
#include <limits>
#include <nanoflann.hpp>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// A point that was found; of two equally far ones the first counts.
struct Found {
  double mm2;
  std::size_t point;
  [[nodiscard]] bool operator<(const Found& other) const {
    return mm2 < other.mm2 || (mm2 == other.mm2 && point < other.point);
  }
};

/// What nanoflann fills while it searches: the `most` nearest within a radius, nearest first.
class Nearest {
 public:
  using DistanceType = double;

  Nearest(std::size_t most, double within_mm2) : most_(most), within_mm2_(within_mm2) {}

  bool addPoint(double mm2, std::size_t point) {
    const Found found{mm2, point};
    if (mm2 > within_mm2_ || (full() && !(found < found_.back()))) return true;
    if (full()) found_.pop_back();
    found_.insert(std::upper_bound(found_.begin(), found_.end(), found), found);
    return true;
  }
  /// A little more than the farthest that counts: nanoflann leaves out what is just as far, and sums its
  /// distances to boxes with rounding.
  [[nodiscard]] double worstDist() const {
    constexpr double kSlack = 1 + 1e-12;
    return kSlack * (full() ? found_.back().mm2 : within_mm2_) + std::numeric_limits<double>::min();
  }
  [[nodiscard]] bool full() const { return found_.size() == most_; }
  [[nodiscard]] std::size_t size() const { return found_.size(); }
  [[nodiscard]] const std::vector<Found>& found() const { return found_; }

 private:
  std::size_t most_;
  double within_mm2_;
  std::vector<Found> found_;
};

/// All within a radius, in any order: no place is kept free for each new one.
class Within {
 public:
  using DistanceType = double;

  explicit Within(double within_mm2) : within_mm2_(within_mm2) {}

  bool addPoint(double mm2, std::size_t point) {
    if (mm2 <= within_mm2_) found.push_back({mm2, point});
    return true;
  }
  [[nodiscard]] double worstDist() const {
    return (1 + 1e-12) * within_mm2_ + std::numeric_limits<double>::min();
  }
  [[nodiscard]] bool full() const { return true; }
  [[nodiscard]] std::size_t size() const { return found.size(); }

  std::vector<Found> found;

 private:
  double within_mm2_;
};

std::vector<std::size_t> points_of(const std::vector<Found>& found) {
  std::vector<std::size_t> points;
  points.reserve(found.size());
  for (const Found& each : found) points.push_back(each.point);
  return points;
}

/// The points in the form in which nanoflann asks for them.
struct Places {
  std::vector<Vec3> points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t point, std::size_t axis) const {
    return points[point](static_cast<Eigen::Index>(axis));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

}  // namespace

struct Neighbours::Tree {
  using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Places>, Places, 3,
                                                    std::size_t>;
  Places places;
  Index index;

  explicit Tree(std::span<const Vec3> points)
      : places{{points.begin(), points.end()}},
        index(3, places, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {}

  template <class Results>
  void find(const Vec3& place, Results& results) const {
    if (!places.points.empty()) index.findNeighbors(results, place.data(), nanoflann::SearchParams());
  }
};

Neighbours::Neighbours(std::span<const Vec3> points) : tree_(std::make_shared<const Tree>(points)) {}

std::optional<std::size_t> Neighbours::nearest(const Vec3& place, double within_mm) const {
  require(within_mm >= 0, "a distance is not negative");
  Nearest one(1, within_mm * within_mm);
  tree_->find(place, one);
  if (one.found().empty()) return std::nullopt;
  return one.found().front().point;
}

std::vector<std::size_t> Neighbours::within(const Vec3& place, double radius_mm) const {
  require(radius_mm >= 0, "a distance is not negative");
  Within all(radius_mm * radius_mm);
  tree_->find(place, all);
  std::sort(all.found.begin(), all.found.end());
  return points_of(all.found);
}

std::vector<std::size_t> Neighbours::few_nearest(const Vec3& place, std::size_t count) const {
  if (count == 0) return {};
  Nearest some(count, std::numeric_limits<double>::infinity());
  tree_->find(place, some);
  return points_of(some.found());
}

}  // namespace asterism
