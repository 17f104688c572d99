// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/display_cloud.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kCellsASide = 1 << 20;

struct Box {
  Vec3 low, high;
};

std::vector<std::uint32_t> finite_points(const Cloud& cloud) {
  std::vector<std::uint32_t> finite;
  finite.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.points[i].allFinite()) finite.push_back(static_cast<std::uint32_t>(i));
  return finite;
}

Box box_of(const Cloud& cloud, const std::vector<std::uint32_t>& points) {
  if (points.empty()) return {Vec3::Zero(), Vec3::Zero()};
  Box box{cloud.points[points.front()], cloud.points[points.front()]};
  for (const std::uint32_t i : points) {
    box.low = box.low.cwiseMin(cloud.points[i]);
    box.high = box.high.cwiseMax(cloud.points[i]);
  }
  return box;
}

/// Which of the six directions along the axes a point's normal is nearest to; 6 where none is known.
std::uint64_t facing(const Cloud& cloud, std::uint32_t point) {
  if (cloud.normals.empty()) return 6;
  const Vec3f& normal = cloud.normals[point];
  if (!(normal.squaredNorm() > 0)) return 6;
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return static_cast<std::uint64_t>(2 * axis + (normal[axis] < 0 ? 1 : 0));
}

struct Place {
  std::uint64_t cube;
  float off;  // from the cube's middle, squared, in cubes
  std::uint32_t point;
  bool operator<(const Place& other) const {
    if (cube != other.cube) return cube < other.cube;
    return off != other.off ? off < other.off : point < other.point;
  }
};

std::vector<Place> places_of(const Cloud& cloud, const std::vector<std::uint32_t>& points, const Vec3& low,
                             double voxel_mm) {
  std::vector<Place> places;
  places.reserve(points.size());
  for (const std::uint32_t i : points) {
    const Vec3 at = (cloud.points[i] - low) / voxel_mm;
    const Vec3 cube = at.array().floor();
    std::uint64_t key = facing(cloud, i);
    for (const double step : cube) key = key << 20 | static_cast<std::uint64_t>(step);
    places.push_back({key, static_cast<float>((at - cube - Vec3::Constant(0.5)).squaredNorm()), i});
  }
  std::sort(places.begin(), places.end());
  return places;
}

std::vector<std::uint32_t> first_of_each_cube(const std::vector<Place>& places) {
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (i == 0 || places[i].cube != places[i - 1].cube) kept.push_back(places[i].point);
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace

DisplayCloud thinned(const Cloud& cloud, std::size_t most) {
  require(most > 6, "a cloud is thinned to some points");
  require(cloud.normals.empty() || cloud.normals.size() == cloud.size(),
          "a cloud has a normal a point or none");
  const std::vector<std::uint32_t> all = finite_points(cloud);
  if (all.size() <= most) return {all, 0};
  const Box box = box_of(cloud, all);
  const double longest_mm = std::max((box.high - box.low).maxCoeff(), 1e-6);
  const auto kept_with = [&](double voxel_mm) {
    return first_of_each_cube(places_of(cloud, all, box.low, voxel_mm));
  };
  // On a surface cubes half as large are four times as many: one guess tells about which size is right.
  const double finest_mm = 2 * longest_mm / kCellsASide;
  const auto sought = static_cast<double>(most);
  const double guess_mm = std::max(longest_mm / std::sqrt(sought), finest_mm);
  const double met = static_cast<double>(kept_with(guess_mm).size());
  for (double voxel_mm = std::max(guess_mm * std::sqrt(met / sought), finest_mm);; voxel_mm *= 1.03) {
    std::vector<std::uint32_t> kept = kept_with(voxel_mm);
    if (kept.size() <= most) return {std::move(kept), voxel_mm};
  }
}

PackedPlaces packed_places(const Cloud& cloud, const std::vector<std::uint32_t>& points) {
  const Box box = box_of(cloud, points);
  PackedPlaces packed;
  packed.low = box.low;
  packed.step_mm = std::max((box.high - box.low).maxCoeff(), 1e-6) / 65535;
  packed.steps.reserve(3 * points.size());
  for (const std::uint32_t i : points)
    for (const double step : Vec3((cloud.points[i] - box.low) / packed.step_mm))
      packed.steps.push_back(static_cast<std::uint16_t>(std::lround(step)));
  return packed;
}

std::vector<std::uint16_t> packed_reals(const std::vector<double>& values,
                                        const std::vector<std::uint32_t>& points) {
  constexpr std::uint16_t kNone = 0x7e00;
  constexpr double kLargest = 65504;
  std::vector<std::uint16_t> packed;
  packed.reserve(points.size());
  for (const std::uint32_t i : points) {
    const double value = values[i];
    const bool there = std::isfinite(value) && std::abs(value) <= kLargest;
    packed.push_back(there ? Eigen::numext::bit_cast<std::uint16_t>(Eigen::half(static_cast<float>(value)))
                           : kNone);
  }
  return packed;
}

std::vector<std::uint16_t> packed_counts(const std::vector<double>& values,
                                         const std::vector<std::uint32_t>& points) {
  std::vector<std::uint16_t> packed;
  packed.reserve(points.size());
  for (const std::uint32_t i : points) {
    const double value = values[i];
    packed.push_back(value >= 0 ? static_cast<std::uint16_t>(std::lround(std::min(value, 65534.0)))
                                : std::uint16_t{65535});
  }
  return packed;
}

}  // namespace asterism
