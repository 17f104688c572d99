// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "asterism/optimization/non_dominated_sort.hpp"

namespace asterism {

/// Evenly spread directions into the positive orthant, at most `count` where that is possible, as unit
/// vectors: points of a simplex lattice (Das & Dennis 1998). Where so few points would all lie on the
/// simplex's rim, a second layer half as large lies within it (Deb & Jain 2014).
/// Returns directions × m, row-major.
[[nodiscard]] std::vector<double> reference_directions(std::size_t m, std::size_t count);

/// Thins the front that does not fit so that every reference direction keeps someone near it (NSGA-III, Deb
/// & Jain 2014): objectives are measured from the ideal point in units of the intercepts of the plane
/// through the extreme points, and directions with the fewest followers are served first. Where the
/// original draws lots, the candidate nearest to its direction goes first.
class ReferencePointNiching {
 public:
  /// Of the fronts before `split` all survive; chooses `places` of front `split`, out of `wanted` survivors
  /// in all. Positions in that front, ascending; valid until the next call.
  std::span<const std::uint32_t> operator()(std::span<const double> objectives, std::size_t m,
                                            const Fronts& fronts, std::size_t split, std::size_t places,
                                            std::size_t wanted);

 private:
  struct Follower {
    double distance;  // from its direction
    std::uint32_t direction;
    std::uint32_t at;  // position in the front
  };
  void normalise(std::span<const double> objectives, std::size_t m, const Fronts& fronts, std::size_t split);
  Follower follow(const double* objectives, std::size_t m, std::uint32_t at);
  void serve(std::size_t places);

  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> known_directions_;
  std::span<const double> directions_;
  std::vector<double> ideal_, unit_;
  std::vector<double> point_;           // the one at hand, in those units
  std::vector<std::size_t> followers_;  // per direction, who survives
  std::vector<Follower> candidates_;
  std::vector<std::tuple<std::size_t, double, std::uint32_t>> turns_;
  std::vector<std::uint32_t> chosen_;
};

}  // namespace asterism
