// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/identifiability.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/geometry/point_sets.hpp"
#include "asterism/geometry/rigid_fit.hpp"
#include "asterism/layout/fit_moments.hpp"

namespace asterism {
namespace {

constexpr std::size_t kMost = 64;

std::uint64_t bit(std::size_t index) { return std::uint64_t{1} << index; }

class Search {
 public:
  Search(std::span<const Vec3> points, std::span<const Vec3> pattern, bool same_body,
         const IdentifiabilityOptions& options, std::span<const std::uint64_t> seen_together)
      : same_body_(same_body),
        fewest_(static_cast<std::size_t>(options.fewest_seen)),
        steps_left_(options.max_steps),
        between_points_(distances_of(points)),
        between_pattern_(distances_of(pattern)),
        pairs_of_points_(pairs_by_distance(points)),
        pairs_of_pattern_(pairs_by_distance(pattern)) {
    // About the middle, so that sums of squares lose no digits.
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
    for (const Vec3& p : points) points_.push_back(p - middle);
    middle.setZero();
    for (const Vec3& p : pattern) middle += p / static_cast<double>(pattern.size());
    for (const Vec3& p : pattern) pattern_.push_back(p - middle);
    for (const std::uint64_t mask : seen_together) {
      const bool within_another =
          std::any_of(seen_together.begin(), seen_together.end(),
                      [&](std::uint64_t other) { return other != mask && (mask & other) == mask; });
      const bool again =
          std::find(seen_together_.begin(), seen_together_.end(), mask) != seen_together_.end();
      if (!within_another && !again) seen_together_.push_back(mask);
    }
  }

  /// Of `fewest_` targets, everything below `cap_mm`, or nothing.
  void run(double cap_mm) {
    best_mean_square_ = cap_mm * cap_mm;
    start_from_pairs();
  }

  /// More than `fewest_` seen, one of them taken for a target that is not.
  void mistake_one() {
    for (std::size_t wrong = 0; wrong < points_.size(); ++wrong) {
      for (std::size_t label = 0; label < pattern_.size(); ++label) {
        if (label == wrong) continue;
        others_.clear();
        const auto seen_at_most = static_cast<double>(points_.size());
        const double largest = seen_at_most * seen_at_most * best_mean_square_;
        for (std::size_t j = 0; j < points_.size(); ++j) {
          if (j == wrong || j == label) continue;
          const double off =
              between_points_[wrong * points_.size() + j] - between_points_[label * points_.size() + j];
          if (off * off < largest) others_.push_back({off * off, j});
        }
        if (others_.size() < fewest_) continue;
        std::sort(others_.begin(), others_.end());
        if (!others_allow_a_fit()) continue;
        seen_[0] = wrong;
        label_[0] = label;
        label_count_ = 1;
        FitMoments moments;
        moments.add(points_[wrong], pattern_[label]);
        keep_more(0, bit(wrong), moments);
        label_count_ = 0;
      }
    }
  }

  [[nodiscard]] bool found() const { return !best_.seen.empty(); }
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] const IdentifiabilityMargin& best() const { return best_; }

 private:
  [[nodiscard]] bool can_be_seen(std::uint64_t seen) const {
    return seen_together_.empty() || std::any_of(seen_together_.begin(), seen_together_.end(),
                                                 [&](std::uint64_t mask) { return (mask & seen) == seen; });
  }

  /// Within a body a labelling and its inverse fit alike, so one of the two is tried, for both.
  [[nodiscard]] bool worth_trying(std::uint64_t seen, std::uint64_t used) const {
    return can_be_seen(seen) || (same_body_ && can_be_seen(used));
  }

  bool spend_step() {
    if (steps_left_ == 0) complete_ = false;
    if (complete_) --steps_left_;
    return complete_;
  }

  /// The first two targets under every two labels as far apart: a window of the sorted distances.
  void start_from_pairs() {
    for (const SpacedPair& pair : pairs_of_points_) {
      const double width = std::sqrt(2.0 * best_mean_square_ * static_cast<double>(fewest_));
      auto match = std::lower_bound(pairs_of_pattern_.begin(), pairs_of_pattern_.end(),
                                    SpacedPair{pair.distance - width, 0, 0});
      for (; match != pairs_of_pattern_.end() && match->distance < pair.distance + width; ++match) {
        const double off = pair.distance - match->distance;
        start(pair, match->first, match->second, off * off);
        start(pair, match->second, match->first, off * off);
        if (!complete_) return;
      }
    }
  }

  void start(const SpacedPair& pair, std::size_t first_label, std::size_t second_label, double squares) {
    if (same_body_ && std::min(first_label, second_label) < pair.first) return;  // its inverse is tried
    const std::uint64_t seen = bit(pair.first) | bit(pair.second);
    const std::uint64_t used = bit(first_label) | bit(second_label);
    if (!worth_trying(seen, used) || !spend_step()) return;
    seen_[0] = pair.first;
    seen_[1] = pair.second;
    label_[0] = first_label;
    label_[1] = second_label;
    label_count_ = 2;
    extend(seen, used, squares);
    label_count_ = 0;
  }

  /// Adds one more of the first `fewest_` targets, each later than the one before, under every label.
  void extend(std::uint64_t seen, std::uint64_t used, double squares) {
    const std::size_t depth = label_count_;
    const std::size_t last = points_.size() - (fewest_ - depth);
    const std::size_t first_label = same_body_ ? seen_[0] : 0;
    for (std::size_t i = seen_[depth - 1] + 1; i <= last; ++i) {
      for (std::size_t to = first_label; to < pattern_.size(); ++to) {
        if ((used >> to) & 1U) continue;
        const double limit =
            best_mean_square_ * static_cast<double>(fewest_) * static_cast<double>(depth + 1);
        const double grown = squares + added_by(i, to, limit - squares);
        if (!(grown < limit) || !worth_trying(seen | bit(i), used | bit(to))) continue;
        if (!spend_step()) return;
        seen_[depth] = i;
        label_[depth] = to;
        ++label_count_;
        if (label_count_ == fewest_) {
          judge();
        } else {
          extend(seen | bit(i), used | bit(to), grown);
        }
        --label_count_;
      }
    }
  }

  [[nodiscard]] double added_by(std::size_t i, std::size_t to, double enough) const {
    const double* of_point = &between_points_[i * points_.size()];
    const double* of_label = &between_pattern_[to * pattern_.size()];
    double added = 0;
    for (std::size_t t = 0; t < label_count_ && added < enough; ++t) {
      const double off = of_point[seen_[t]] - of_label[label_[t]];
      added += off * off;
    }
    return added;
  }

  void judge() {
    FitMoments moments;
    for (std::size_t t = 0; t < label_count_; ++t) moments.add(points_[seen_[t]], pattern_[label_[t]]);
    judge(moments);
  }

  /// Takes the labelling as the best one when it is wrong and fits better.
  void judge(const FitMoments& moments) {
    if (same_body_ && std::equal(seen_.begin(), seen_.begin() + label_count_, label_.begin())) return;
    const auto count = static_cast<double>(label_count_);
    if (!(least_squares_sum(moments) < best_mean_square_ * count)) return;
    std::vector<Vec3> a, b;
    for (std::size_t t = 0; t < label_count_; ++t) {
      a.push_back(points_[seen_[t]]);
      b.push_back(pattern_[label_[t]]);
    }
    // Points on a line leave the turn about it open, but not how well they fit.
    const auto fit = fit_rigid_motion(a, b);
    const double mean_square = fit ? fit->rms * fit->rms : std::max(0.0, least_squares_sum(moments)) / count;
    if (!(mean_square < best_mean_square_)) return;
    best_mean_square_ = mean_square;
    best_.rms_mm = std::sqrt(mean_square);
    std::uint64_t seen = 0;
    for (std::size_t t = 0; t < label_count_; ++t) seen |= bit(seen_[t]);
    const bool inverse = !can_be_seen(seen);
    std::vector<std::pair<int, int>> pairs;
    for (std::size_t t = 0; t < label_count_; ++t) {
      const auto target = static_cast<int>(seen_[t]);
      const auto label = static_cast<int>(label_[t]);
      pairs.push_back(inverse ? std::pair(label, target) : std::pair(target, label));
    }
    std::sort(pairs.begin(), pairs.end());
    best_.seen.clear();
    best_.taken_for.clear();
    for (const auto& [target, label] : pairs) {
      best_.seen.push_back(target);
      best_.taken_for.push_back(label);
    }
  }

  [[nodiscard]] bool others_allow_a_fit() const {
    double squares = 0;
    for (std::size_t count = 1; count <= others_.size(); ++count) {
      squares += others_[count - 1].square;
      const auto seen = static_cast<double>(count + 1);
      if (count >= fewest_ && squares < seen * seen * best_mean_square_) return true;
    }
    return false;
  }

  /// Adds some of others_[from…] under their own labels. Residuals only grow as targets join.
  void keep_more(std::size_t from, std::uint64_t seen, const FitMoments& moments) {
    if (label_count_ > fewest_) judge(moments);
    for (std::size_t o = from; o < others_.size(); ++o) {
      if (label_count_ + others_.size() - o <= fewest_) return;
      const std::size_t j = others_[o].target;
      const std::uint64_t with = seen | bit(j);
      if (!can_be_seen(with)) continue;
      if (!spend_step()) return;
      FitMoments more = moments;
      more.add(points_[j], pattern_[j]);
      const auto at_most = static_cast<double>(label_count_ + others_.size() - o);
      if (label_count_ >= 2 && !(least_squares_sum(more) < best_mean_square_ * at_most)) continue;
      seen_[label_count_] = label_[label_count_] = j;
      ++label_count_;
      keep_more(o + 1, with, more);
      --label_count_;
    }
  }

  struct Other {
    double square;  // of (distance to the mistaken target − distance to what it is taken for)
    std::size_t target;
    [[nodiscard]] auto operator<=>(const Other&) const = default;
  };

  bool same_body_;
  std::size_t fewest_;
  std::size_t steps_left_;
  std::vector<double> between_points_, between_pattern_;
  std::vector<SpacedPair> pairs_of_points_, pairs_of_pattern_;  // by distance
  std::vector<Vec3> points_, pattern_;
  std::vector<std::uint64_t> seen_together_;
  std::array<std::size_t, kMost> seen_{}, label_{};
  std::size_t label_count_ = 0;
  std::vector<Other> others_;
  double best_mean_square_ = 0;
  bool complete_ = true;
  IdentifiabilityMargin best_;
};

IdentifiabilityMargin search(std::span<const Vec3> points, std::span<const Vec3> pattern, bool same_body,
                             const IdentifiabilityOptions& options,
                             std::span<const std::uint64_t> seen_together) {
  require(points.size() <= kMost && pattern.size() <= kMost, "a layout has at most 64 targets");
  require(options.fewest_seen >= 3, "a labelling is judged by three points or more");
  const auto fewest = static_cast<std::size_t>(options.fewest_seen);
  if (points.size() < fewest || pattern.size() < fewest) return {options.cap_mm, {}, {}, true};
  // Small margins are found fast under a small cap, so the cap grows until one is found.
  Search in(points, pattern, same_body, options, seen_together);
  for (double cap = std::min(options.cap_mm, 0.5);; cap = std::min(options.cap_mm, 3 * cap)) {
    in.run(cap);
    if (in.found() || !in.complete() || cap >= options.cap_mm) break;
  }
  if (same_body && in.complete()) in.mistake_one();
  IdentifiabilityMargin margin = in.best();
  if (!in.found()) margin.rms_mm = options.cap_mm;
  margin.complete = in.complete();
  return margin;
}

}  // namespace

IdentifiabilityMargin identifiability_margin(std::span<const Vec3> targets,
                                             const IdentifiabilityOptions& options,
                                             std::span<const std::uint64_t> seen_together) {
  return search(targets, targets, true, options, seen_together);
}

IdentifiabilityMargin identifiability_between(std::span<const Vec3> targets,
                                              std::span<const Vec3> of_other_body,
                                              const IdentifiabilityOptions& options) {
  return search(targets, of_other_body, false, options, {});
}

}  // namespace asterism
