// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

// The search for known patterns of points in a scene by the distances between them, which no rigid motion
// changes. It knows nothing of targets or bodies. Distances cannot tell a pattern from its mirror image:
// whoever uses a match must still ask whether a proper rotation fits it.

namespace asterism {

/// A place and how well it is known, in any frame.
struct UncertainPoint {
  Vec3 position;    // mm
  Mat3 covariance;  // mm²
};

/// This point of the pattern is that point of the scene; both by index.
struct Correspondence {
  int pattern;
  int scene;
  [[nodiscard]] bool operator==(const Correspondence&) const = default;
  [[nodiscard]] auto operator<=>(const Correspondence&) const = default;
};

/// Two correspondences that can hold at once: the distance is the same in pattern and scene.
struct CompatiblePair {
  Correspondence first, second;
};

/// Does the distance between two points of the pattern differ from that between two of the scene by less
/// than `gate` standard deviations?
[[nodiscard]] bool distances_agree(const UncertainPoint& pattern_a, const UncertainPoint& pattern_b,
                                   const UncertainPoint& scene_a, const UncertainPoint& scene_b, double gate);

/// What a scene point is made of; two points that share one cannot both be real. −1 = nothing.
using Claims = std::array<int, 2>;
[[nodiscard]] inline bool share_a_claim(const Claims& a, const Claims& b) {
  return (a[0] >= 0 && a[0] == b[0]) || (a[1] >= 0 && a[1] == b[1]);
}

/// The compatible pairs of each pattern, or that there were too many to list.
struct CompatiblePairs {
  std::vector<std::vector<CompatiblePair>> of_pattern;
  bool complete = true;
};

/// All pair distances of several patterns, sorted and indexed, made once and asked in every frame.
class PairDistanceTable {
 public:
  explicit PairDistanceTable(std::span<const std::vector<UncertainPoint>> patterns);

  /// Pairs whose distances differ by less than `gate` standard deviations of the difference.
  /// `claims` may be empty; else one a scene point. Stops after `max_pairs`.
  [[nodiscard]] CompatiblePairs match(std::span<const UncertainPoint> scene, std::span<const Claims> claims,
                                      double gate, std::size_t max_pairs) const;

  [[nodiscard]] double longest_mm() const { return entries_.empty() ? 0.0 : entries_.back().distance; }

 private:
  struct Entry {
    double distance;
    double variance;  // a bound: the pattern's attitude is not known
    int pattern, a, b;
  };
  [[nodiscard]] std::size_t first_not_below(double distance) const;

  std::vector<Entry> entries_;          // by distance
  std::vector<std::size_t> bucket_of_;  // the first entry of each stretch of distance
  double per_mm_ = 0;                   // stretches
  double largest_variance_ = 0;
  std::size_t patterns_ = 0;
};

struct CliqueLimits {
  int min_size = 3;
  std::size_t max_cliques = 512;
  std::size_t max_nodes = 4096;
  std::size_t max_work = 10'000'000;  // words of 64 correspondences looked at; some 10 ms
};

/// Sets of correspondences of which every two are compatible, none part of a larger one, each sorted.
struct Cliques {
  std::vector<std::vector<Correspondence>> found;
  bool complete = true;  // false: a limit was met, so there may be more
};

/// Bron & Kerbosch 1973 with the pivot of Tomita et al. 2006, after all correspondences with fewer than
/// min_size − 1 partners have been dropped. Every pair is listed once.
[[nodiscard]] Cliques grow_cliques(std::span<const CompatiblePair> pairs, std::size_t pattern_points,
                                   std::size_t scene_points, const CliqueLimits& limits = {});

}  // namespace asterism
