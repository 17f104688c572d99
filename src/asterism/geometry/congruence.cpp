// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/congruence.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::size_t kBuckets = 2048;

/// No direction has more variance than this (Gershgorin).
double largest_variance(const Mat3& covariance) { return covariance.cwiseAbs().rowwise().sum().maxCoeff(); }

double variance_along(const Vec3& unit, const UncertainPoint& a, const UncertainPoint& b) {
  return unit.dot((a.covariance + b.covariance) * unit);
}

}  // namespace

bool distances_agree(const UncertainPoint& pattern_a, const UncertainPoint& pattern_b,
                     const UncertainPoint& scene_a, const UncertainPoint& scene_b, double gate) {
  const Vec3 apart = scene_b.position - scene_a.position;
  const double distance = apart.norm();
  if (!(distance > 0)) return false;
  const double off = distance - (pattern_b.position - pattern_a.position).norm();
  const double variance = variance_along(apart / distance, scene_a, scene_b) +
                          largest_variance(pattern_a.covariance) + largest_variance(pattern_b.covariance);
  return off * off < gate * gate * variance;
}

PairDistanceTable::PairDistanceTable(std::span<const std::vector<UncertainPoint>> patterns)
    : patterns_(patterns.size()) {
  for (std::size_t p = 0; p < patterns.size(); ++p) {
    for (std::size_t b = 1; b < patterns[p].size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        const UncertainPoint& from = patterns[p][a];
        const UncertainPoint& to = patterns[p][b];
        entries_.push_back({(to.position - from.position).norm(),
                            largest_variance(from.covariance) + largest_variance(to.covariance),
                            static_cast<int>(p), static_cast<int>(a), static_cast<int>(b)});
        largest_variance_ = std::max(largest_variance_, entries_.back().variance);
      }
    }
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& x, const Entry& y) { return x.distance < y.distance; });
  if (!(longest_mm() > 0)) return;
  per_mm_ = static_cast<double>(kBuckets) / longest_mm();
  std::size_t entry = 0;
  for (std::size_t bucket = 0; bucket <= kBuckets; ++bucket) {
    while (entry < entries_.size() && entries_[entry].distance * per_mm_ < static_cast<double>(bucket))
      ++entry;
    bucket_of_.push_back(entry);
  }
}

std::size_t PairDistanceTable::first_not_below(double distance) const {
  if (distance <= 0) return 0;
  std::size_t entry = bucket_of_[std::min(kBuckets, static_cast<std::size_t>(distance * per_mm_))];
  while (entry < entries_.size() && entries_[entry].distance < distance) ++entry;
  return entry;
}

CompatiblePairs PairDistanceTable::match(std::span<const UncertainPoint> scene,
                                         std::span<const Claims> claims, double gate,
                                         std::size_t max_pairs) const {
  require(claims.empty() || claims.size() == scene.size(), "each scene point has its claims");
  CompatiblePairs matches{std::vector<std::vector<CompatiblePair>>(patterns_), true};
  if (entries_.empty()) return matches;

  std::vector<double> bound(scene.size());
  std::transform(scene.begin(), scene.end(), bound.begin(),
                 [](const UncertainPoint& point) { return largest_variance(point.covariance); });
  std::size_t count = 0;
  for (std::size_t j = 1; j < scene.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const Vec3 apart = scene[j].position - scene[i].position;
      const double squared = apart.squaredNorm();
      const double reach = gate * std::sqrt(bound[i] + bound[j] + largest_variance_);
      if (squared > (longest_mm() + reach) * (longest_mm() + reach)) continue;
      const double distance = std::sqrt(squared);
      std::size_t entry = first_not_below(distance - reach);
      if (entry == entries_.size() || entries_[entry].distance > distance + reach) continue;
      if (!claims.empty() && share_a_claim(claims[i], claims[j])) continue;
      if (!(distance > 0)) continue;

      const double variance = variance_along(apart / distance, scene[i], scene[j]);
      for (; entry < entries_.size() && entries_[entry].distance <= distance + reach; ++entry) {
        const Entry& known = entries_[entry];
        const double off = distance - known.distance;
        if (off * off > gate * gate * (variance + known.variance)) continue;
        if (count >= max_pairs) return {std::move(matches.of_pattern), false};
        const int si = static_cast<int>(i);
        const int sj = static_cast<int>(j);
        auto& pairs = matches.of_pattern[static_cast<std::size_t>(known.pattern)];
        pairs.push_back({{known.a, si}, {known.b, sj}});
        pairs.push_back({{known.b, si}, {known.a, sj}});
        count += 2;
      }
    }
  }
  return matches;
}

}  // namespace asterism
