// SPDX-License-Identifier: Apache-2.0
// How long non-dominated sorting, survival and hypervolume take; beside pagmo where it is installed, with
// which the ranks and the volumes must agree.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "asterism/core/random.hpp"
#include "asterism/optimization/archive.hpp"
#include "asterism/optimization/hypervolume.hpp"
#include "asterism/optimization/non_dominated_sort.hpp"
#include "asterism/optimization/survival.hpp"
#include "bench.hpp"

#include <pagmo/utils/hypervolume.hpp>
#include <pagmo/utils/multi_objective.hpp>

using namespace asterism;

namespace {

enum class Shape { Cube, Front, Ties };

/// In a cube; on a sphere's octant, one front; on a coarse grid, with ties and copies.
std::vector<double> points(std::size_t count, std::size_t m, Shape shape, std::uint64_t seed = 2026) {
  RandomStream random(seed, m);
  std::vector<double> x(count * m);
  for (double& value : x) value = shape == Shape::Ties ? random.below(20) : random.uniform();
  for (std::size_t i = 0; shape == Shape::Front && i < x.size(); i += m) {
    double norm = 0;
    for (std::size_t k = 0; k < m; ++k) norm += x[i + k] * x[i + k];
    for (std::size_t k = 0; k < m; ++k) x[i + k] /= std::sqrt(norm);
  }
  return x;
}

std::string name_of(Shape shape) {
  return shape == Shape::Cube ? "cube" : shape == Shape::Front ? "one front" : "ties";
}

std::string ms(double seconds) { return fmt::format("{:.4g}", seconds * 1e3); }

std::vector<pagmo::vector_double> for_pagmo(const std::vector<double>& x, std::size_t m) {
  std::vector<pagmo::vector_double> list;
  for (std::size_t i = 0; i < x.size(); i += m)
    list.emplace_back(x.begin() + static_cast<std::ptrdiff_t>(i),
                      x.begin() + static_cast<std::ptrdiff_t>(i + m));
  return list;
}

/// Ours and pagmo's, timed in turn; `agree` tells whether both found the same.
void row_beside_pagmo(bench::Table& table, std::vector<std::string> cells, const std::function<void()>& ours,
                      const std::function<void()>& peer, const std::function<bool()>& agree, int repeats) {
  if (!peer) {
    cells.insert(cells.end(), {ms(bench::median_seconds(ours)), "-", "-", "-"});
  } else {
    const auto seconds = bench::median_seconds_in_turn({ours, peer}, repeats);
    cells.insert(cells.end(), {ms(seconds[0]), ms(seconds[1]), fmt::format("{:.0f}", seconds[1] / seconds[0]),
                               agree() ? "yes" : "NO"});
  }
  table.row(cells);
}

void sort_row(bench::Table& table, std::size_t count, std::size_t m, Shape shape) {
  const auto x = points(count, m, shape);
  NonDominatedSort sort;
  std::function<void()> peer;
  std::function<bool()> agree;
  const auto list = for_pagmo(x, m);
  decltype(pagmo::fast_non_dominated_sorting(list)) theirs;
  if (count <= 10000) peer = [&] { theirs = pagmo::fast_non_dominated_sorting(list); };
  agree = [&] {
    const auto& rank = sort.fronts().rank;
    const auto& their_rank = std::get<3>(theirs);
    return std::equal(rank.begin(), rank.end(), their_rank.begin(), their_rank.end(),
                      [](int a, auto b) { return static_cast<decltype(b)>(a) == b; });
  };
  row_beside_pagmo(
      table, {std::to_string(m), std::to_string(count), name_of(shape)}, [&] { sort(x, m); }, peer, agree,
      count >= 10000 ? 3 : 11);
}

void sort_table() {
  bench::Table table("Non-dominated sorting, ms",
                     {"objectives", "points", "shape", "asterism", "pagmo", "ratio", "same ranks"});
  for (const std::size_t m : {2, 3, 4, 6})
    for (const std::size_t count : {100, 200, 1000, 10000, 100000, 1000000})
      for (const Shape shape : {Shape::Cube, Shape::Front, Shape::Ties}) {
        const bool too_long = (m > 2 && count > 100000) || (m > 3 && count > 10000);
        const bool too_much = m > 3 && count == 10000 && shape == Shape::Ties;  // of pagmo's memory
        if (!too_long && !too_much) sort_row(table, count, m, shape);
      }
  table.print_json();
}

/// Sixty-four populations in turn, so that the branches of one are not learnt by heart.
void survival_table() {
  bench::Table table("Survivors: half of a merged population, us",
                     {"objectives", "merged", "shape", "crowding", "automatic"});
  for (const std::size_t m : {2, 3, 4})
    for (const std::size_t count : {200, 2000})
      for (const Shape shape : {Shape::Cube, Shape::Front}) {
        std::vector<std::vector<double>> sets;
        for (std::uint64_t seed = 0; seed < 64; ++seed) sets.push_back(points(count, m, shape, seed));
        std::vector<std::string> cells = {std::to_string(m), std::to_string(count), name_of(shape)};
        for (const Survival how : {Survival::Crowding, Survival::Automatic}) {
          SurvivorSelection select(how);
          std::size_t set = 0;
          const double seconds = bench::median_seconds(
              [&] {
                select({sets[++set % 64], m}, count / 2);
              },
              count > 1000 ? 5 : 15);
          cells.push_back(fmt::format("{:.1f}", seconds * 1e6));
        }
        table.row(cells);
      }
  table.print_json();
}

void hypervolume_table() {
  bench::Table table("Hypervolume of one front, ms",
                     {"objectives", "points", "what", "asterism", "pagmo", "ratio", "agree"});
  for (const std::size_t m : {2, 3, 4, 5})
    for (const std::size_t count : {100, 1000}) {
      if (m == 5 && count > 100) continue;
      const auto x = points(count, m, Shape::Front);
      const std::vector<double> reference(m, 1.1);
      double ours = 0, theirs = 0;
      std::vector<double> our_shares, their_shares;
      std::function<void()> peer, peer_of_shares;
      const auto list = for_pagmo(x, m);
      peer = [&] { theirs = pagmo::hypervolume(list, false).compute(reference); };
      peer_of_shares = [&] { their_shares = pagmo::hypervolume(list, false).contributions(reference); };
      const std::vector<std::string> cells = {std::to_string(m), std::to_string(count)};
      row_beside_pagmo(
          table, {cells[0], cells[1], "whole"}, [&] { ours = hypervolume(x, m, reference); }, peer,
          [&] { return std::abs(ours - theirs) < 1e-9; }, 5);
      if (m > 3) continue;
      row_beside_pagmo(
          table, {cells[0], cells[1], "contributions"},
          [&] { our_shares = hypervolume_contributions(x, m, reference); }, peer_of_shares,
          [&] {
            return std::ranges::equal(our_shares, their_shares,
                                      [](double a, double b) { return std::abs(a - b) < 1e-9; });
          },
          5);
    }
  table.print_json();
}

void archive_table() {
  bench::Table table("Archive: candidates offered one by one, ms",
                     {"objectives", "shape", "offered", "held", "asterism"});
  for (const std::size_t m : {2, 3, 4})
    for (const Shape shape : {Shape::Cube, Shape::Front}) {
      const auto x = points(shape == Shape::Cube || m == 2 ? 100000 : 20000, m, shape);
      std::size_t held = 0;
      const double seconds = bench::median_seconds(
          [&] {
            ParetoArchive archive(m);
            for (std::size_t i = 0; i < x.size(); i += m) archive.add(std::span(x).subspan(i, m), i);
            held = archive.size();
          },
          3);
      table.row({std::to_string(m), name_of(shape), std::to_string(x.size() / m), std::to_string(held),
                 ms(seconds)});
    }
  table.print_json();
}

}  // namespace

int main() {
  sort_table();
  survival_table();
  hypervolume_table();
  archive_table();
}
