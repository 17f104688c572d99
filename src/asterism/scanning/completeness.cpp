// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/completeness.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/scanning/holes.hpp"

namespace asterism {
namespace {

constexpr std::size_t kChunk = 8192;

using Cell = std::array<std::int32_t, 3>;

std::size_t hash_of(const Cell& cell) {
  std::uint64_t hash = 0;
  for (const std::int32_t part : cell) {
    hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace

void describe(CompletenessOptions& options, OptionVisitor& visit) {
  visit.number("radius_mm", options.radius_mm, {0.01, 1000},
               "a place is measured when enough points lie so near");
  visit.integer("points", options.points, {1, 1000000}, "so many of them");
  visit.number("off_mm", options.off_mm, {1e-4, 1000}, "and no farther off the surface than this");
  visit.number("max_turn_deg", options.max_turn_deg, {1, 89}, "between a point's normal and the place's");
}

/// Space in cells; each knows the samples that a point in it may count for, so a point looks at one cell.
struct CompletenessCount::Grid {
  struct Slot {
    Cell cell{};
    std::uint32_t begin = 0, end = 0;  // of `samples`; none: a free slot
  };
  Vec3 origin = Vec3::Zero();
  double edge_mm;
  std::array<double, 3> cells{};  // along each axis
  std::vector<Slot> slots;        // a table with open addresses; its size is a power of two
  std::vector<std::uint32_t> samples;

  Grid(std::span<const SurfaceSample> all, double radius_mm) : edge_mm(2 * radius_mm) {
    if (all.empty()) return;
    origin = all.front().at;
    Vec3 highest = origin;
    for (const SurfaceSample& sample : all) {
      origin = origin.cwiseMin(sample.at);
      highest = highest.cwiseMax(sample.at);
    }
    origin.array() -= radius_mm;
    for (int axis = 0; axis < 3; ++axis) {
      cells[static_cast<std::size_t>(axis)] =
          std::floor((highest(axis) + radius_mm - origin(axis)) / edge_mm) + 1;
    }
    fill(all, radius_mm);
  }

  void fill(std::span<const SurfaceSample> all, double radius_mm) {
    std::vector<std::pair<Cell, std::uint32_t>> entries;
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      // The ball around a place is as wide as a cell, so it touches two along each axis at the most.
      const Cell low = cell_of(all[i].at.array() - radius_mm), high = cell_of(all[i].at.array() + radius_mm);
      for (std::int32_t x = low[0]; x <= high[0]; ++x) {
        for (std::int32_t y = low[1]; y <= high[1]; ++y) {
          for (std::int32_t z = low[2]; z <= high[2]; ++z) entries.push_back({{x, y, z}, i});
        }
      }
    }
    std::sort(entries.begin(), entries.end());
    std::size_t size = 16;
    while (size < 2 * entries.size()) size *= 2;
    slots.resize(size);
    for (std::size_t i = 0; i < entries.size();) {
      Slot slot{entries[i].first, static_cast<std::uint32_t>(i), 0};
      for (; i < entries.size() && entries[i].first == slot.cell; ++i) samples.push_back(entries[i].second);
      slot.end = static_cast<std::uint32_t>(i);
      std::size_t at = hash_of(slot.cell) & (size - 1);
      while (slots[at].end > 0) at = (at + 1) & (size - 1);
      slots[at] = slot;
    }
  }

  [[nodiscard]] Cell cell_of(const Vec3& place) const {
    Cell cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      cell[axis] = static_cast<std::int32_t>(std::floor((place(a) - origin(a)) / edge_mm));
    }
    return cell;
  }

  /// Samples that may lie within the radius; a place that is not a number is near none.
  [[nodiscard]] std::span<const std::uint32_t> near(const Vec3& place) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      const double at = (place(a) - origin(a)) / edge_mm;
      if (!(at >= 0 && at < cells[axis])) return {};
    }
    const Cell cell = cell_of(place);
    for (std::size_t at = hash_of(cell) & (slots.size() - 1); slots[at].end > 0;
         at = (at + 1) & (slots.size() - 1)) {
      const Slot& slot = slots[at];
      if (slot.cell == cell) return std::span(samples).subspan(slot.begin, slot.end - slot.begin);
    }
    return {};
  }
};

CompletenessCount::CompletenessCount(std::span<const SurfaceSample> samples,
                                     const CompletenessOptions& options)
    : samples_(samples.begin(), samples.end()),
      options_(options),
      grid_(std::make_shared<const Grid>(samples, options.radius_mm)),
      points_(samples.size(), 0) {}

void CompletenessCount::add(const Cloud& cloud) {
  require(cloud.normals.empty() || cloud.normals.size() == cloud.size(), "each point or none has a normal");
  const double radius2 = options_.radius_mm * options_.radius_mm;
  const double lowest_cosine = std::cos(rad_from_deg(options_.max_turn_deg));
  parallel_for((cloud.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    std::vector<std::uint32_t> near;
    const std::size_t end = std::min(cloud.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const Vec3& point = cloud.points[i];
      near.clear();
      Vec3 lent = Vec3::Zero();
      double nearest_plane = std::numeric_limits<double>::infinity();
      for (const std::uint32_t s : grid_->near(point)) {
        const Vec3 off = point - samples_[s].at;
        const double height = std::abs(samples_[s].normal.dot(off));
        if (off.squaredNorm() > radius2 || height > options_.off_mm) continue;
        near.push_back(s);
        if (height >= nearest_plane) continue;
        nearest_plane = height;
        lent = samples_[s].normal;
      }
      const bool has_normal = !cloud.normals.empty() && cloud.normals[i].squaredNorm() > 0;
      const Vec3 normal = has_normal ? Vec3(cloud.normals[i].cast<double>()) : lent;
      for (const std::uint32_t s : near) {
        if (samples_[s].normal.dot(normal) < lowest_cosine) continue;
        // Whole numbers come to the same sum in any order.
        std::atomic_ref(points_[s]).fetch_add(1, std::memory_order_relaxed);
      }
    }
  });
}

Completeness CompletenessCount::finish() const {
  Completeness found;
  found.points = points_;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const bool enough = points_[i] >= options_.points;
    found.measured.push_back(enough ? 1 : 0);
    if (samples_[i].weight <= 0) continue;
    found.surface_mm2 += samples_[i].area_mm2;
    if (enough) found.measured_mm2 += samples_[i].area_mm2;
  }
  found.holes = holes_of(samples_, found.measured, options_.max_turn_deg);
  return found;
}

Completeness completeness_of(const Cloud& cloud, std::span<const SurfaceSample> samples,
                             const CompletenessOptions& options) {
  CompletenessCount count(samples, options);
  count.add(cloud);
  return count.finish();
}

}  // namespace asterism
