// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/reference_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// Points of the lattice of m shares out of `divisions`.
std::size_t lattice_size(std::size_t m, std::size_t divisions) {
  double size = 1;
  for (std::size_t k = 1; k < m; ++k) size *= static_cast<double>(divisions + k) / static_cast<double>(k);
  return static_cast<std::size_t>(std::min(std::round(size), 1e9));
}

/// Most divisions with at most `count` points, 0 if none.
std::size_t most_divisions(std::size_t m, std::size_t count) {
  std::size_t divisions = 0;
  while (lattice_size(m, divisions + 1) <= count) ++divisions;
  return divisions;
}

/// Adds the lattice, drawn towards the simplex's middle by `scale`.
void add_lattice(std::size_t m, std::size_t divisions, double scale, std::vector<double>& points) {
  std::vector<std::size_t> share(m, 0);
  share[m - 1] = divisions;
  for (;;) {
    for (const std::size_t s : share)
      points.push_back(scale * static_cast<double>(s) / static_cast<double>(divisions) +
                       (1 - scale) / static_cast<double>(m));
    // The next composition of `divisions`: one more before the last heap, the rest of which goes to the end.
    std::size_t k = m - 1;
    while (k > 0 && share[k] == 0) --k;
    if (k == 0) return;
    const std::size_t heap = share[k];
    share[k] = 0;
    ++share[k - 1];
    share[m - 1] = heap - 1;
  }
}

/// Solves A x = (1, …, 1) by elimination with pivots; empty if A, row-major, is as good as singular.
std::vector<double> solve_for_ones(std::vector<double> a, std::size_t m) {
  std::vector<double> x(m, 1.0);
  for (std::size_t column = 0; column < m; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < m; ++row)
      if (std::abs(a[row * m + column]) > std::abs(a[pivot * m + column])) pivot = row;
    if (!(std::abs(a[pivot * m + column]) > 1e-12)) return {};
    std::swap_ranges(a.begin() + static_cast<std::ptrdiff_t>(column * m),
                     a.begin() + static_cast<std::ptrdiff_t>((column + 1) * m),
                     a.begin() + static_cast<std::ptrdiff_t>(pivot * m));
    std::swap(x[column], x[pivot]);
    for (std::size_t row = 0; row < m; ++row) {
      if (row == column) continue;
      const double factor = a[row * m + column] / a[column * m + column];
      for (std::size_t k = column; k < m; ++k) a[row * m + k] -= factor * a[column * m + k];
      x[row] -= factor * x[column];
    }
  }
  for (std::size_t k = 0; k < m; ++k) x[k] /= a[k * m + k];
  return x;
}

/// The point of the front that lies nearest to an axis: the others weigh a million times as much.
std::uint32_t extreme_point(std::span<const double> objectives, std::size_t m,
                            std::span<const std::uint32_t> front, std::span<const double> ideal,
                            std::span<const double> width, std::size_t axis) {
  std::uint32_t best = front[0];
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : front) {
    double worst = 0;
    for (std::size_t k = 0; k < m; ++k)
      worst = std::max(worst, (objectives[i * m + k] - ideal[k]) / width[k] * (k == axis ? 1 : 1e6));
    if (worst < least) {
      least = worst;
      best = i;
    }
  }
  return best;
}

}  // namespace

std::vector<double> reference_directions(std::size_t m, std::size_t count) {
  require(m > 0, "there is something to minimise");
  std::vector<double> points;
  const std::size_t divisions = std::max<std::size_t>(1, m == 1 ? 1 : most_divisions(m, count));
  const std::size_t rest = count - std::min(count, lattice_size(m, divisions));
  add_lattice(m, divisions, 1, points);
  if (divisions < m && m > 1) {
    const std::size_t inner = std::min(divisions, most_divisions(m, rest));
    if (inner > 0) add_lattice(m, inner, 0.5, points);
  }
  for (std::size_t i = 0; i < points.size(); i += m) {
    double norm = 0;
    for (std::size_t k = 0; k < m; ++k) norm += points[i + k] * points[i + k];
    for (std::size_t k = 0; k < m; ++k) points[i + k] /= std::sqrt(norm);
  }
  return points;
}

std::span<const std::uint32_t> ReferencePointNiching::operator()(std::span<const double> objectives,
                                                                 std::size_t m, const Fronts& fronts,
                                                                 std::size_t split, std::size_t places,
                                                                 std::size_t wanted) {
  const auto front = fronts.front(split);
  require(places <= front.size(), "enough are there to choose from");
  auto& directions = known_directions_[{m, wanted}];
  if (directions.empty()) directions = reference_directions(m, wanted);
  directions_ = directions;

  normalise(objectives, m, fronts, split);
  followers_.assign(directions_.size() / m, 0);
  for (std::size_t k = 0; k < split; ++k)
    for (const std::uint32_t i : fronts.front(k))
      ++followers_[follow(objectives.data() + i * m, m, 0).direction];
  candidates_.clear();
  for (std::uint32_t at = 0; at < front.size(); ++at)
    candidates_.push_back(follow(objectives.data() + front[at] * m, m, at));
  serve(places);
  return chosen_;
}

/// Ideal point and units from the first front. Where its extreme points span no plane, or one that meets an
/// axis nowhere sensible, the front's worst values take the intercepts' place.
void ReferencePointNiching::normalise(std::span<const double> objectives, std::size_t m, const Fronts& fronts,
                                      std::size_t split) {
  ideal_.assign(m, std::numeric_limits<double>::infinity());
  point_.resize(m);
  unit_.assign(m, -std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f <= split; ++f)
    for (const std::uint32_t i : fronts.front(f))
      for (std::size_t k = 0; k < m; ++k) {
        ideal_[k] = std::min(ideal_[k], objectives[i * m + k]);
        if (f == 0) unit_[k] = std::max(unit_[k], objectives[i * m + k]);
      }
  for (std::size_t k = 0; k < m; ++k) {
    unit_[k] -= ideal_[k];
    if (!(unit_[k] > 0)) unit_[k] = 1;
  }

  std::vector<double> extremes;  // in units of the front's widths
  for (std::size_t axis = 0; axis < m; ++axis) {
    const std::uint32_t i = extreme_point(objectives, m, fronts.front(0), ideal_, unit_, axis);
    for (std::size_t k = 0; k < m; ++k) extremes.push_back((objectives[i * m + k] - ideal_[k]) / unit_[k]);
  }
  const auto inverse = solve_for_ones(extremes, m);
  if (std::ranges::any_of(inverse, [](double x) { return x < 1e-6 || x > 1e6; })) return;
  // An intercept beyond the worst value is no better a measure than that value.
  for (std::size_t k = 0; k < inverse.size(); ++k) unit_[k] /= std::max(1.0, inverse[k]);
}

ReferencePointNiching::Follower ReferencePointNiching::follow(const double* objectives, std::size_t m,
                                                              std::uint32_t at) {
  double norm = 0;
  for (std::size_t k = 0; k < m; ++k) {
    point_[k] = (objectives[k] - ideal_[k]) / unit_[k];
    norm += point_[k] * point_[k];
  }
  double along = -1;
  std::uint32_t nearest = 0;
  for (std::size_t d = 0; d < directions_.size() / m; ++d) {
    double dot = 0;
    for (std::size_t k = 0; k < m; ++k) dot += directions_[d * m + k] * point_[k];
    if (dot > along) {
      along = dot;
      nearest = static_cast<std::uint32_t>(d);
    }
  }
  return {std::max(0.0, norm - along * along), nearest, at};
}

/// In rounds: every direction with the fewest followers gets its nearest candidate, if it has one left.
void ReferencePointNiching::serve(std::size_t places) {
  std::ranges::sort(candidates_, {},
                    [](const Follower& f) { return std::tuple(f.direction, f.distance, f.at); });
  // A candidate's turn is the number of followers its direction will have had before it.
  turns_.clear();
  std::size_t before = 0;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Follower& candidate = candidates_[i];
    before = i > 0 && candidates_[i - 1].direction == candidate.direction ? before + 1
                                                                          : followers_[candidate.direction];
    turns_.emplace_back(before, candidate.distance, candidate.at);
  }
  std::ranges::sort(turns_);
  chosen_.clear();
  for (std::size_t i = 0; i < places; ++i) chosen_.push_back(std::get<2>(turns_[i]));
  std::ranges::sort(chosen_);
}

}  // namespace asterism
