// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/point_sets.hpp"

#include <algorithm>

namespace asterism {

Vec3 centroid_of(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

std::vector<double> distances_of(std::span<const Vec3> points) {
  std::vector<double> distances;
  distances.reserve(points.size() * points.size());
  for (const Vec3& a : points) {
    for (const Vec3& b : points) distances.push_back((a - b).norm());
  }
  return distances;
}

std::vector<SpacedPair> pairs_by_distance(std::span<const Vec3> points) {
  std::vector<SpacedPair> pairs;
  pairs.reserve(points.size() * points.size() / 2);
  for (std::size_t j = 0; j < points.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) pairs.push_back({(points[i] - points[j]).norm(), i, j});
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace asterism
