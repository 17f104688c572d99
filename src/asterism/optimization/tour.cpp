// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/tour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

using Order = std::vector<std::uint32_t>;
constexpr double kGain_s = 1e-9;  // less is rounding

void check(const TourProblem& problem) {
  const std::size_t n = problem.stops;
  if (problem.time_s.size() != n * n)
    throw InputError("tour", fmt::format("{} times for {} stops; {} are needed, from each to each",
                                         problem.time_s.size(), n, n * n));
  if (problem.first && *problem.first >= n)
    throw InputError("tour",
                     fmt::format("begins at stop {}, but there are {}, counted from 0", *problem.first, n));
  for (std::size_t k = 0; k < n * n; ++k)
    if (k / n != k % n && !(problem.time_s[k] >= 0 && std::isfinite(problem.time_s[k])))
      throw InputError("tour", fmt::format("from stop {} to {} takes {} s; it must be 0 or more", k / n,
                                           k % n, problem.time_s[k]));
}

class Ways {
 public:
  explicit Ways(const TourProblem& problem) : n_(problem.stops), time_s_(problem.time_s) {}
  double operator()(std::uint32_t from, std::uint32_t to) const { return time_s_[from * n_ + to]; }
  [[nodiscard]] double length(const Order& order) const {
    double sum = 0;
    for (std::size_t k = 1; k < order.size(); ++k) sum += (*this)(order[k - 1], order[k]);
    return sum;
  }

 private:
  std::size_t n_;
  const std::vector<double>& time_s_;
};

Order nearest_from(const Ways& way, std::size_t stops, std::uint32_t first) {
  Order order{first}, left;
  for (std::uint32_t stop = 0; stop < stops; ++stop)
    if (stop != first) left.push_back(stop);
  while (!left.empty()) {
    const auto next = std::min_element(left.begin(), left.end(), [&](std::uint32_t a, std::uint32_t b) {
      return way(order.back(), a) < way(order.back(), b);
    });
    order.push_back(*next);
    left.erase(next);
  }
  return order;
}

Order nearest(const Ways& way, const TourProblem& problem) {
  if (problem.first) return nearest_from(way, problem.stops, *problem.first);
  Order best;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t first = 0; first < problem.stops; ++first) {
    Order order = nearest_from(way, problem.stops, first);
    const double length = way.length(order);
    if (length >= least) continue;
    least = length;
    best = std::move(order);
  }
  return best;
}

/// Each stop in turn where it adds least; the next is the one that adds least of all.
Order cheapest_insertion(const Ways& way, const TourProblem& problem) {
  Order order{problem.first.value_or(0)}, left;
  for (std::uint32_t stop = 0; stop < problem.stops; ++stop)
    if (stop != order[0]) left.push_back(stop);
  const std::size_t begin = problem.first ? 1 : 0;
  while (!left.empty()) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t which = 0, where = 0;
    for (std::size_t k = 0; k < left.size(); ++k)
      for (std::size_t at = begin; at <= order.size(); ++at) {
        const std::uint32_t stop = left[k];
        double adds = 0;
        if (at > 0) adds += way(order[at - 1], stop);
        if (at < order.size()) adds += way(stop, order[at]);
        if (at > 0 && at < order.size()) adds -= way(order[at - 1], order[at]);
        if (adds >= least) continue;
        least = adds;
        which = k;
        where = at;
      }
    order.insert(order.begin() + static_cast<std::ptrdiff_t>(where), left[which]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(which));
  }
  return order;
}

/// Moves and turns stretches as long as that helps.
class Improvement {
 public:
  Improvement(const Ways& way, bool first_is_fixed) : way_(way), begin_(first_is_fixed ? 1 : 0) {}

  void operator()(Order& order) {
    order_ = std::move(order);
    while (turn_stretches() || move_stretches()) {
    }
    order = std::move(order_);
  }

 private:
  /// Between the stops at two places; nothing before the first and behind the last.
  [[nodiscard]] double between(std::size_t from, std::size_t to) const {
    return from >= order_.size() || to >= order_.size() ? 0 : way_(order_[from], order_[to]);
  }

  /// The way along the tour up to each place, forth and back.
  void measure() {
    forth_.assign(order_.size(), 0);
    back_.assign(order_.size(), 0);
    for (std::size_t k = 1; k < order_.size(); ++k) {
      forth_[k] = forth_[k - 1] + way_(order_[k - 1], order_[k]);
      back_[k] = back_[k - 1] + way_(order_[k], order_[k - 1]);
    }
  }
  [[nodiscard]] double turning(std::size_t from, std::size_t to) const {
    return back_[to] - back_[from] - (forth_[to] - forth_[from]);
  }

  bool turn_stretches() {
    bool helped = false;
    measure();
    for (std::size_t from = begin_; from < order_.size(); ++from)
      for (std::size_t to = from + 1; to < order_.size(); ++to) {
        const double adds = between(from - 1, to) + between(from, to + 1) - between(from - 1, from) -
                            between(to, to + 1) + turning(from, to);
        if (adds > -kGain_s) continue;
        std::reverse(place(from), place(to + 1));
        measure();
        helped = true;
      }
    return helped;
  }

  bool move_stretches() {
    constexpr std::size_t kLongest = 3;
    bool helped = false;
    for (std::size_t from = begin_; from < order_.size(); ++from)
      for (std::size_t to = from; to < std::min(from + kLongest, order_.size()); ++to)
        if (move_stretch(from, to)) helped = true;
    return helped;
  }

  /// To where it helps most, either way round.
  bool move_stretch(std::size_t from, std::size_t to) {
    const double frees = between(from - 1, from) + between(to, to + 1) - between(from - 1, to + 1);
    double turned = 0;
    for (std::size_t k = from; k < to; ++k) turned += between(k + 1, k) - between(k, k + 1);
    double least = -kGain_s;
    std::size_t where = order_.size() + 1;
    bool turns = false;
    for (std::size_t at = begin_; at <= order_.size(); ++at) {  // before the stop that is there
      if (at >= from && at <= to + 1) continue;
      const double closes = between(at - 1, at) + frees;
      const double straight = between(at - 1, from) + between(to, at) - closes;
      const double reversed = between(at - 1, to) + between(from, at) + turned - closes;
      if (std::min(straight, reversed) >= least) continue;
      least = std::min(straight, reversed);
      where = at;
      turns = reversed < straight;
    }
    if (where > order_.size()) return false;
    if (turns) std::reverse(place(from), place(to + 1));
    if (where < from)
      std::rotate(place(where), place(from), place(to + 1));
    else
      std::rotate(place(from), place(to + 1), place(where));
    return true;
  }

  [[nodiscard]] Order::iterator place(std::size_t k) {
    return order_.begin() + static_cast<std::ptrdiff_t>(k);
  }

  const Ways& way_;
  std::size_t begin_;  // the first place that may change
  Order order_;
  std::vector<double> forth_, back_;
};

/// Two neighbouring stretches change places.
Order shaken(const Order& order, std::size_t begin, RandomStream& random) {
  std::array<std::size_t, 3> cut{};
  const auto places = static_cast<std::uint32_t>(order.size() - begin + 1);
  for (std::size_t& at : cut) at = begin + random.below(places);
  std::sort(cut.begin(), cut.end());
  Order changed = order;
  const auto at = [&](std::size_t k) { return changed.begin() + static_cast<std::ptrdiff_t>(cut[k]); };
  std::rotate(at(0), at(1), at(2));
  return changed;
}

}  // namespace

Tour short_tour(const TourProblem& problem) {
  check(problem);
  if (problem.stops == 0) return {};
  const Ways way(problem);
  Tour tour;
  tour.order = nearest(way, problem);
  tour.nearest_length_s = tour.length_s = way.length(tour.order);
  Improvement improve(way, problem.first.has_value());
  const auto take = [&](Order order) {
    improve(order);
    const double length = way.length(order);
    if (length >= tour.length_s - kGain_s) return;
    tour.length_s = length;
    tour.order = std::move(order);
  };
  take(tour.order);
  take(cheapest_insertion(way, problem));
  // a fixed amount of work, of which a pass over the tour takes some ten ways a pair of stops
  constexpr std::size_t kWork = 60'000'000, kMostShakes = 1000;
  const std::size_t shakes = std::min(kMostShakes, kWork / (30 * problem.stops * problem.stops));
  RandomStream random(0, problem.stops, 0x70042);
  for (std::size_t shake = 0; shake < shakes && problem.stops > 3; ++shake)
    take(shaken(tour.order, problem.first ? 1 : 0, random));
  return tour;
}

}  // namespace asterism
