// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/congruence_margin.hpp"

#include <algorithm>

#include "asterism/core/result.hpp"
#include "asterism/geometry/point_sets.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

class Search {
 public:
  Search(std::span<const Vec3> points, std::span<const Vec3> pattern, std::span<const int> right,
         double cap_mm, std::size_t max_steps)
      : points_(points),
        pattern_(pattern),
        right_(right),
        max_steps_(max_steps),
        lowest_rms_(cap_mm),
        between_points_(distances_of(points)),
        between_pattern_(distances_of(pattern)),
        used_(pattern.size()) {}

  /// Narrows the cap to the best labelling found; the last one found is the best.
  WrongLabellings best() {
    narrowing_ = true;
    extend(0.0);
    return std::move(search_);
  }

  WrongLabellings all() {
    extend(0.0);
    return std::move(search_);
  }

 private:
  void extend(double squares) {
    if (label_.size() == points_.size()) return judge();
    struct Branch {
      double squares;
      int label;
    };
    const auto count = static_cast<double>(label_.size() + 1);
    std::vector<Branch> branches;
    for (std::size_t to = 0; to < pattern_.size(); ++to) {
      if (used_[to]) continue;
      const double grown = squares + added_by(to);
      if (bound(grown, count) < lowest_rms_) branches.push_back({grown, static_cast<int>(to)});
    }
    std::stable_sort(branches.begin(), branches.end(),
                     [](const Branch& a, const Branch& b) { return a.squares < b.squares; });
    for (const auto& [grown, to] : branches) {
      if (++steps_ > max_steps_) search_.complete = false;
      if (!search_.complete || !(bound(grown, count) < lowest_rms_)) return;
      label_.push_back(to);
      used_[static_cast<std::size_t>(to)] = true;
      extend(grown);
      used_[static_cast<std::size_t>(to)] = false;
      label_.pop_back();
    }
  }

  /// The least RMS over all points that the distances among the first `count` of them allow.
  [[nodiscard]] double bound(double squares, double count) const {
    return std::sqrt(squares / (count * static_cast<double>(points_.size())));
  }

  [[nodiscard]] double added_by(std::size_t to) const {
    const std::size_t next = label_.size();
    double added = 0;
    for (std::size_t i = 0; i < next; ++i) {
      const double off = between_points_[i * points_.size() + next] -
                         between_pattern_[static_cast<std::size_t>(label_[i]) * pattern_.size() + to];
      added += off * off;
    }
    return added;
  }

  void judge() {
    if (std::equal(label_.begin(), label_.end(), right_.begin(), right_.end())) return;
    std::vector<Vec3> to;
    for (const int label : label_) to.push_back(pattern_[static_cast<std::size_t>(label)]);
    const auto fit = fit_rigid_motion(points_, to);
    if (!fit || !(fit->rms < lowest_rms_)) return;
    if (narrowing_) lowest_rms_ = fit->rms;
    search_.found.push_back({fit->rms, label_});
  }

  std::span<const Vec3> points_, pattern_;
  std::span<const int> right_;
  std::size_t max_steps_;
  double lowest_rms_;
  std::vector<double> between_points_, between_pattern_;
  std::vector<int> label_;
  std::vector<bool> used_;
  std::size_t steps_ = 0;
  bool narrowing_ = false;
  WrongLabellings search_;
};

void check(std::span<const Vec3> points, std::span<const int> right) {
  require(points.size() >= 3, "a labelling is judged by three points or more");
  require(right.empty() || right.size() == points.size(), "the right labelling labels every point");
}

}  // namespace

WrongLabellingSearch best_wrong_labelling(std::span<const Vec3> points, std::span<const Vec3> pattern,
                                          std::span<const int> right, double cap_mm, std::size_t max_steps) {
  check(points, right);
  if (pattern.size() < points.size()) return {};
  WrongLabellings search = Search(points, pattern, right, cap_mm, max_steps).best();
  WrongLabellingSearch best{std::nullopt, search.complete};
  if (!search.found.empty()) best.best = std::move(search.found.back());
  return best;
}

WrongLabellings wrong_labellings_within(std::span<const Vec3> points, std::span<const Vec3> pattern,
                                        std::span<const int> right, double cap_mm, std::size_t max_steps) {
  check(points, right);
  if (pattern.size() < points.size()) return {};
  return Search(points, pattern, right, cap_mm, max_steps).all();
}

}  // namespace asterism
