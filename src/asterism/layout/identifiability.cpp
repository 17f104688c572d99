// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/identifiability.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

constexpr std::size_t kMost = 64;

/// Distances between all points, row by row.
std::vector<double> distances_of(std::span<const Vec3> points) {
  std::vector<double> distances;
  distances.reserve(points.size() * points.size());
  for (const Vec3& a : points) {
    for (const Vec3& b : points) distances.push_back((a - b).norm());
  }
  return distances;
}

/// What the RMS of pairs of points depends on, as they are added and taken away.
struct Moments {
  double count = 0;
  Vec3 sum_a = Vec3::Zero(), sum_b = Vec3::Zero();
  Mat3 cross = Mat3::Zero();
  double squares = 0;

  void add(const Vec3& a, const Vec3& b) {
    count += 1;
    sum_a += a;
    sum_b += b;
    cross += a * b.transpose();
    squares += a.squaredNorm() + b.squaredNorm();
  }
};

/// No more than the sum of the squared residuals of the best proper rigid fit, and hardly less: the largest
/// root of λ⁴ − 2|S|²λ² − 8 det(S) λ + |S|⁴ − 4|cof S|², by Newton's method from above (Horn 1987,
/// Theobald 2005). Near a double root, as of flat layouts, it is known to the square root of rounding.
double least_squares_sum(const Moments& m) {
  const Mat3 s = m.cross - m.sum_a * m.sum_b.transpose() / m.count;
  const double spread = m.squares - (m.sum_a.squaredNorm() + m.sum_b.squaredNorm()) / m.count;
  const Vec3 minors0 = s.col(1).cross(s.col(2));
  const double norm2 = s.squaredNorm();
  const double minors2 =
      minors0.squaredNorm() + s.col(2).cross(s.col(0)).squaredNorm() + s.col(0).cross(s.col(1)).squaredNorm();
  const double c1 = -8.0 * s.col(0).dot(minors0);
  const double c0 = norm2 * norm2 - 4.0 * minors2;
  double root = 0.5 * spread;
  for (int i = 0; i < 40; ++i) {
    const double square = root * root;
    const double value = square * (square - 2.0 * norm2) + c1 * root + c0;
    const double slope = 4.0 * root * (square - norm2) + c1;
    if (!(slope > 0)) break;
    const double step = value / slope;
    root -= step;
    if (std::abs(step) < 1e-12 * root) break;
  }
  constexpr double kDoubleRoot = 2e-7;
  return spread - 2.0 * root - kDoubleRoot * spread;
}

class Search {
 public:
  Search(std::span<const Vec3> points, std::span<const Vec3> pattern, bool same_body,
         const IdentifiabilityOptions& options, std::span<const std::uint64_t> seen_together)
      : same_body_(same_body),
        fewest_(static_cast<std::size_t>(options.fewest_seen)),
        steps_left_(options.max_steps),
        between_points_(distances_of(points)),
        between_pattern_(distances_of(pattern)) {
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

  /// Everything below `cap_mm`, or nothing.
  void run(double cap_mm) {
    best_mean_square_ = cap_mm * cap_mm;
    extend(0, 0, 0.0, Moments{});
    if (same_body_) mistake_one();
  }

  [[nodiscard]] bool found() const { return !best_.seen.empty(); }
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] const IdentifiabilityMargin& best() const { return best_; }

 private:
  [[nodiscard]] bool can_be_seen(std::uint64_t seen) const {
    return seen_together_.empty() || std::any_of(seen_together_.begin(), seen_together_.end(),
                                                 [&](std::uint64_t mask) { return (mask & seen) == seen; });
  }

  bool spend_step() {
    if (steps_left_ == 0) complete_ = false;
    if (complete_) --steps_left_;
    return complete_;
  }

  /// Adds one more of the first `fewest_` targets, each later than the one before, under every label.
  void extend(std::uint64_t seen, std::uint64_t used, double squares, const Moments& moments) {
    const std::size_t depth = label_count_;
    const std::size_t first = depth == 0 ? 0 : seen_[depth - 1] + 1;
    const std::size_t last = points_.size() - (fewest_ - depth);
    for (std::size_t i = first; i <= last; ++i) {
      const std::uint64_t with = seen | std::uint64_t{1} << i;
      if (!can_be_seen(with)) continue;
      for (std::size_t to = 0; to < pattern_.size(); ++to) {
        if ((used >> to) & 1U) continue;
        const double limit =
            best_mean_square_ * static_cast<double>(fewest_) * static_cast<double>(depth + 1);
        const double grown = squares + added_by(i, to, limit - squares);
        if (!(grown < limit)) continue;
        if (!spend_step()) return;
        seen_[depth] = i;
        label_[depth] = to;
        ++label_count_;
        Moments more = moments;
        more.add(points_[i], pattern_[to]);
        if (label_count_ == fewest_) {
          judge(more);
        } else {
          extend(with, used | std::uint64_t{1} << to, grown, more);
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

  /// Takes the labelling as the best one when it is wrong and fits better.
  void judge(const Moments& moments) {
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
    best_.seen.assign(seen_.begin(), seen_.begin() + label_count_);
    best_.taken_for.assign(label_.begin(), label_.begin() + label_count_);
  }

  /// More than `fewest_` seen, one of them taken for a target that is not.
  void mistake_one() {
    for (std::size_t wrong = 0; wrong < points_.size(); ++wrong) {
      for (std::size_t label = 0; label < pattern_.size(); ++label) {
        if (label == wrong) continue;
        others_.clear();
        for (std::size_t j = 0; j < points_.size(); ++j) {
          if (j == wrong || j == label) continue;
          const double off =
              between_points_[wrong * points_.size() + j] - between_points_[label * points_.size() + j];
          others_.push_back({off * off, j});
        }
        std::sort(others_.begin(), others_.end());
        if (!others_allow_a_fit()) continue;
        seen_[0] = wrong;
        label_[0] = label;
        label_count_ = 1;
        Moments moments;
        moments.add(points_[wrong], pattern_[label]);
        keep_more(0, std::uint64_t{1} << wrong, moments);
        label_count_ = 0;
      }
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
  void keep_more(std::size_t from, std::uint64_t seen, const Moments& moments) {
    if (label_count_ > fewest_) judge_sorted(moments);
    for (std::size_t o = from; o < others_.size(); ++o) {
      if (label_count_ + others_.size() - o <= fewest_) return;
      const std::size_t j = others_[o].target;
      const std::uint64_t with = seen | std::uint64_t{1} << j;
      if (!can_be_seen(with)) continue;
      if (!spend_step()) return;
      Moments more = moments;
      more.add(points_[j], pattern_[j]);
      const auto at_most = static_cast<double>(label_count_ + others_.size() - o);
      if (label_count_ >= 2 && !(least_squares_sum(more) < best_mean_square_ * at_most)) continue;
      seen_[label_count_] = label_[label_count_] = j;
      ++label_count_;
      keep_more(o + 1, with, more);
      --label_count_;
    }
  }

  void judge_sorted(const Moments& moments) {
    judge(moments);
    if (best_.seen.size() != label_count_ || std::is_sorted(best_.seen.begin(), best_.seen.end())) return;
    std::vector<std::pair<int, int>> pairs;
    for (std::size_t t = 0; t < best_.seen.size(); ++t) pairs.emplace_back(best_.seen[t], best_.taken_for[t]);
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t t = 0; t < pairs.size(); ++t) {
      best_.seen[t] = pairs[t].first;
      best_.taken_for[t] = pairs[t].second;
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
