// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "asterism/core/random.hpp"
#include "asterism/optimization/set_cover.hpp"

namespace asterism {

/// Hit every 4-cycle of the n-cube with fewest edges: CYC n of the OR-Library (Grossman & Wool 1997).
inline SetCoverProblem cube_cycles(int n) {
  const std::uint32_t corners = 1U << n;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> edge;  // by its lower corner and its bit
  for (std::uint32_t corner = 0; corner < corners; ++corner)
    for (std::uint32_t bit = 1; bit < corners; bit <<= 1)
      if ((corner & bit) == 0) edge.emplace(std::pair(corner, bit), edge.size());
  SetCoverProblem problem;
  problem.columns.resize(edge.size());
  for (std::uint32_t corner = 0; corner < corners; ++corner)
    for (std::uint32_t a = 1; a < corners; a <<= 1)
      for (std::uint32_t b = a << 1; b < corners; b <<= 1) {
        if ((corner & (a | b)) != 0) continue;
        for (const auto& side :
             {std::pair(corner, a), std::pair(corner, b), std::pair(corner | b, a), std::pair(corner | a, b)})
          problem.columns[edge.at(side)].push_back(static_cast<std::uint32_t>(problem.rows));
        ++problem.rows;
      }
  return problem;
}

using Triples = std::vector<std::array<std::uint32_t, 3>>;

/// Steiner triple system of 9 or 15 points (Bose 1939), or three times another's (Fulkerson et al. 1974).
inline Triples steiner_triples(std::uint32_t points) {
  Triples triples;
  const std::uint32_t q = points / 3;
  if (points == 9 || points == 15) {
    for (std::uint32_t x = 0; x < q; ++x) {
      triples.push_back({x, x + q, x + 2 * q});
      for (std::uint32_t y = x + 1; y < q; ++y)
        for (std::uint32_t i = 0; i < 3; ++i)
          triples.push_back({x + i * q, y + i * q, (x + y) * (q + 1) / 2 % q + (i + 1) % 3 * q});
    }
    return triples;
  }
  for (std::uint32_t x = 0; x < q; ++x) triples.push_back({x, x + q, x + 2 * q});
  constexpr std::array<std::array<std::uint32_t, 3>, 9> kLayers{
      {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (const auto& t : steiner_triples(q))
    for (const auto& layer : kLayers)
      triples.push_back({t[0] + layer[0] * q, t[1] + layer[1] * q, t[2] + layer[2] * q});
  return triples;
}

/// Fewest points that hit every triple: STS n.
inline SetCoverProblem steiner_cover(std::uint32_t points) {
  SetCoverProblem problem;
  problem.columns.resize(points);
  for (const auto& triple : steiner_triples(points)) {
    for (const std::uint32_t point : triple)
      problem.columns[point].push_back(static_cast<std::uint32_t>(problem.rows));
    ++problem.rows;
  }
  return problem;
}

/// Each column covers a row with probability `filled`.
inline SetCoverProblem random_cover(std::size_t rows, std::size_t columns, double filled,
                                    std::uint64_t seed) {
  RandomStream random(seed, 0);
  SetCoverProblem problem;
  problem.rows = rows;
  problem.columns.resize(columns);
  for (auto& column : problem.columns)
    for (std::uint32_t i = 0; i < rows; ++i)
      if (random.uniform() < filled) column.push_back(i);
  return problem;
}

/// Discs on a square see the points in them, `across` of the square wide: views that see samples.
inline SetCoverProblem disc_cover(std::size_t rows, std::size_t columns, double across, std::uint64_t seed) {
  RandomStream random(seed, 1);
  std::vector<std::array<double, 2>> point(rows);
  for (auto& p : point) p = {random.uniform(), random.uniform()};
  SetCoverProblem problem;
  problem.rows = rows;
  problem.columns.resize(columns);
  for (auto& column : problem.columns) {
    const double x = random.uniform(), y = random.uniform();
    const double radius = 0.5 * across * random.uniform(0.7, 1);
    for (std::uint32_t i = 0; i < rows; ++i)
      if (std::hypot(point[i][0] - x, point[i][1] - y) < radius) column.push_back(i);
  }
  return problem;
}

/// What these columns cost, and the weight of what they cover; straight from the definition.
struct CoverWorth {
  double cost = 0, covered = 0, coverable = 0;
};
inline CoverWorth worth_of(const SetCoverProblem& problem, const std::vector<std::uint32_t>& chosen) {
  std::vector<int> count(problem.rows, 0), able(problem.rows, 0);
  for (const auto& column : problem.columns)
    for (const auto i : column) ++able[i];
  CoverWorth worth;
  std::vector<char> open(problem.group_cost.size(), 0);
  for (const auto j : chosen) {
    worth.cost += problem.cost.empty() ? 1 : problem.cost[j];
    if (!problem.group.empty() && open[problem.group[j]] == 0) {
      open[problem.group[j]] = 1;
      worth.cost += problem.group_cost[problem.group[j]];
    }
    for (const auto i : problem.columns[j]) ++count[i];
  }
  for (std::size_t i = 0; i < problem.rows; ++i) {
    const int demand = std::min(able[i], problem.demand.empty() ? 1 : problem.demand[i]);
    const double weight = problem.weight.empty() ? 1 : problem.weight[i];
    if (demand > 0) worth.coverable += weight;
    if (demand > 0 && count[i] >= demand) worth.covered += weight;
  }
  return worth;
}

inline bool is_enough(const SetCoverProblem& problem, const CoverWorth& worth) {
  return worth.covered >= (problem.share - 2e-9) * worth.coverable;
}

/// The least cost of all covers, by trying each set of columns.
inline double least_cost(const SetCoverProblem& problem) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t set = 0; set < 1U << problem.columns.size(); ++set) {
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t j = 0; j < problem.columns.size(); ++j)
      if ((set >> j & 1U) != 0) chosen.push_back(j);
    const CoverWorth worth = worth_of(problem, chosen);
    if (is_enough(problem, worth)) least = std::min(least, worth.cost);
  }
  return least;
}

}  // namespace asterism
