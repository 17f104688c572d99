// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/next_generation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/random.hpp"
#include "asterism/layout/genome.hpp"
#include "asterism/optimization/variation.hpp"
#include "asterism/reproduction/printed.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kBreeding = 0x62726564, kTournament = 0x746f7572, kAveraging = 0x65713330;
constexpr std::size_t kChildren = 50000;

/// Who of two wins; a tie goes half to each.
double share_of_first(const Scheme& first, const Scheme& second) {
  if (first.rank != second.rank) return first.rank < second.rank ? 1.0 : 0.0;
  if (first.crowding == second.crowding) return 0.5;
  return first.crowding > second.crowding ? 1.0 : 0.0;
}

double factorial(int n) { return std::tgamma(n + 1.0); }

}  // namespace

std::vector<std::array<double, 2>> children_of_table9(double bound_mm, std::size_t count,
                                                      std::uint64_t seed) {
  const std::vector<Scheme> schemes = schemes_of_table9();
  const Variation variation;
  const std::vector<double> lowest(12, -bound_mm), highest(12, bound_mm);
  std::vector<std::array<double, 2>> children;
  children.reserve(count);
  std::vector<double> daughter, son;
  for (std::size_t pair = 0; children.size() < count; ++pair) {
    RandomStream random(seed, pair, kBreeding);
    const auto pick = [&] {
      return genes_of(schemes[random.below(static_cast<std::uint32_t>(schemes.size()))].targets);
    };
    const std::vector<double> mother = pick(), father = pick();
    variation.cross(mother, father, lowest, highest, daughter, son, random);
    for (std::vector<double>* child : {&daughter, &son}) {
      variation.mutate(*child, lowest, highest, random);
      if (children.size() < count) children.push_back(objectives_of(positions_of(*child)));
    }
  }
  return children;
}

LedgerRow row_of_reach(std::uint64_t seed) {
  const double f1 = std::stod(printed::kTable11[0].f1_mm);
  std::vector<Reading> readings;
  for (const double bound : {700.0, 1000.0, 2000.0}) {
    double largest = 0;
    for (const auto& child : children_of_table9(bound, kChildren, seed))
      largest = std::max(largest, child[0]);
    readings.push_back({fmt::format("coordinates within ±{:g} mm", bound),
                        fmt::format("largest f1 {:.0f} mm", largest), largest >= f1 - 0.05});
  }
  return compare_readings(
      {"T11.1", "Table 11", "row 1, a child of the five schemes, (f1, f2) mm",
       "(" + printed::kTable11[0].f1_mm + ", " + printed::kTable11[0].f2_mm + ")"},
      readings,
      fmt::format("bounds and seed are not told; {} children by one crossover and mutation", kChildren));
}

LedgerRow row_of_small_child(std::uint64_t seed) {
  const double f1 = std::stod(printed::kTable11[1].f1_mm), f2 = std::stod(printed::kTable11[1].f2_mm);
  std::size_t near = 0;
  for (const auto& child : children_of_table9(1000, kChildren, seed)) {
    near += std::abs(child[0] - f1) < 1 && std::abs(child[1] - f2) < 10;
  }
  return not_computable({"T11.2", "Table 11", "row 2, a child of S1 by its values, (f1, f2) mm",
                         "(" + printed::kTable11[1].f1_mm + ", " + printed::kTable11[1].f2_mm + ")"},
                        "children are random and the seed is not told; such a child is possible",
                        fmt::format("{} of {} children within 1 mm and 10 mm", near, kChildren),
                        "one crossover and mutation of Tables 5 and 6 of two of the five schemes");
}

std::vector<double> tournament_odds(const std::vector<Scheme>& schemes) {
  const double n = static_cast<double>(schemes.size());
  std::vector<double> odds(schemes.size());
  for (std::size_t a = 0; a < schemes.size(); ++a) {
    for (std::size_t b = 0; b < schemes.size(); ++b) {
      const double share = a == b ? 0.5 : share_of_first(schemes[a], schemes[b]);
      odds[a] += share / (n * n);
      odds[b] += (1 - share) / (n * n);
    }
  }
  return odds;
}

std::vector<std::size_t> draw_parents(const std::vector<Scheme>& schemes, std::uint64_t seed) {
  RandomStream random(seed, 0, kTournament);
  std::vector<std::size_t> parents;
  for (int tournament = 0; tournament < 5; ++tournament) {
    const std::size_t a = random.below(5), b = random.below(5);
    parents.push_back(random.uniform() < share_of_first(schemes[a], schemes[b]) ? a : b);
  }
  return parents;
}

std::vector<LedgerRow> rows_of_operators(const std::vector<Scheme>& schemes) {
  std::vector<LedgerRow> rows;
  const std::vector<double> odds = tournament_odds(schemes);
  const double set =
      factorial(5) / (factorial(2) * factorial(2)) * odds[0] * odds[0] * odds[1] * odds[1] * odds[4];
  rows.push_back(not_computable(
      {"P.F19.tournament_parents", "Fig. 19", "parents of the five tournaments", "S1 S2 S1 S2 S5"},
      "tournaments are random and the seed is not told; this set of parents is possible",
      fmt::format("probability of this set {:.3f}", set),
      "binary tournament by front, then crowding; two of five drawn with replacement"));
  rows.push_back(compare_text(
      {"P.42.mutation_probability", "Section 4.2", "probability of mutation, per variable", "1/12"},
      fmt::format("1/{}", genes_of(schemes[0].targets).size()),
      {"one over the number of coordinates of four targets, as Table 6 says", "", ""}));
  const VariationOptions defaults;
  rows.push_back(compare({"P.42.eta_c", "Section 4.2", "distribution index of the crossover", "20"},
                         defaults.crossover_index, {"Table 5's 20, in use here", "", ""}));
  rows.push_back(compare({"P.42.eta_m", "Section 4.2", "distribution index of the mutation", "20"},
                         defaults.mutation_index, {"Table 6's 20, in use here", "", ""}));
  rows.push_back(
      not_computable({"P.42.crossover_probability", "Section 4.2", "probability of crossover", "0.9"},
                     "a setting; no printed figure depends on it alone. In use here",
                     fmt::format("{:g}", defaults.crossover_probability), "as printed"));

  // Equation 30 against Table 5: the spread of children over the spread of their parents.
  std::vector<double> parents, means;
  RandomStream random(1, 0, kAveraging);
  for (int i = 0; i < 20000; ++i) {
    parents.push_back(random.normal());
    parents.push_back(random.normal());
    means.push_back((parents[parents.size() - 2] + parents.back()) / 2);
  }
  const double ratio = std::pow(summarize(means).deviation / summarize(parents).deviation, 2);
  rows.push_back(
      judge({"E30", "Eq. 30 and Table 5", "variance of the children over that of the parents", "1"},
            fmt::format("{:.2f}", ratio), std::abs(ratio - 1) < 0.05,
            {"children as the mean of their parents (Eq. 30)",
             "averaging halves the variance in each generation and cannot widen a front; Table 5's crossover "
             "keeps it, and is used here",
             ""}));
  return rows;
}

}  // namespace asterism
