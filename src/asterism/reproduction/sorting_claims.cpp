// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/sorting_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/random.hpp"
#include "asterism/layout/metrics.hpp"
#include "asterism/optimization/non_dominated_sort.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kPoints = 0x70747333, kLayouts = 0x6c617973;

std::vector<double> random_points(std::size_t count, std::size_t m, std::uint64_t seed, std::uint64_t index) {
  RandomStream random(seed, index, kPoints);
  std::vector<double> objectives(count * m);
  for (double& value : objectives) value = std::floor(random.uniform() * 64);  // ties on purpose
  return objectives;
}

/// How the comparisons grow: the exponent between two sizes.
double growth(double fewer, double more, double factor) { return std::log(more / fewer) / std::log(factor); }

double comparisons(std::size_t count, std::size_t m, std::uint64_t seed) {
  return static_cast<double>(sort_as_table3(random_points(count, m, seed, 0), m).comparisons);
}

Vec3 on_cylinder(RandomStream& random) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return {350 * std::cos(angle), 350 * std::sin(angle), random.uniform(580, 620)};
}

/// The largest mean pair distance that is left when one target is taken away, over that of all.
double best_share_without_one(const std::vector<Vec3>& targets) {
  double best = 0;
  for (std::size_t without = 0; without < targets.size(); ++without) {
    std::vector<Vec3> rest = targets;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(without));
    best = std::max(best, measure_layout(rest).mean_pair_distance_mm);
  }
  return best / measure_layout(targets).mean_pair_distance_mm;
}

LedgerRow row_of_conflict(std::uint64_t seed) {
  constexpr int kTried = 1000;
  int shrinkable = 0;
  for (int i = 0; i < kTried; ++i) {
    RandomStream random(seed, static_cast<std::uint64_t>(i), kLayouts);
    std::vector<Vec3> targets(5 + random.below(6));
    for (Vec3& target : targets) target = on_cylinder(random);
    shrinkable += best_share_without_one(targets) >= 1;
  }
  return judge(
      {"S32.conflict", "Section 3.2",
       "fewest targets (Eq. 23) and largest mean spacing (Eq. 24) are in conflict", "yes"},
      fmt::format("{} of {} layouts gain spacing by losing a target", shrinkable, kTried), shrinkable == 0,
      {"random layouts of 5 to 10 targets on a cylinder; the best one of those with one target less",
       "the mean spacing is the average over its subsets with one target less, so one of them is at least as "
       "wide: the front of the two objectives is one point, N = 4",
       ""});
}

}  // namespace

CountedSort sort_as_table3(std::span<const double> objectives, std::size_t m) {
  const std::size_t count = objectives.size() / m;
  CountedSort sorted{std::vector<int>(count, -1), 0};
  std::vector<std::vector<std::size_t>> dominated(count);  // DomSet
  std::vector<int> dominators(count, 0);                   // DomCount
  const auto dominates = [&](std::size_t p, std::size_t q) {
    bool better = false, worse = false;
    for (std::size_t k = 0; k < m; ++k) {
      ++sorted.comparisons;
      better = better || objectives[p * m + k] < objectives[q * m + k];
      worse = worse || objectives[p * m + k] > objectives[q * m + k];
    }
    return better && !worse;
  };
  std::vector<std::size_t> front;
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t q = 0; q < count; ++q) {
      if (p == q) continue;
      if (dominates(p, q)) dominated[p].push_back(q);
      if (dominates(q, p)) ++dominators[p];
    }
    if (dominators[p] == 0) front.push_back(p);
  }
  for (int rank = 0; !front.empty(); ++rank) {
    std::vector<std::size_t> next;
    for (const std::size_t p : front) {
      sorted.rank[p] = rank;
      for (const std::size_t q : dominated[p]) {
        if (--dominators[q] == 0) next.push_back(q);
      }
    }
    front = std::move(next);
  }
  return sorted;
}

std::vector<LedgerRow> rows_of_sorting(std::uint64_t seed) {
  std::vector<LedgerRow> rows;
  constexpr int kSets = 200;
  int same = 0;
  for (int i = 0; i < kSets; ++i) {
    const std::size_t m = 2 + static_cast<std::size_t>(i) % 3;
    const std::vector<double> points = random_points(60, m, seed, static_cast<std::uint64_t>(i) + 1);
    same += sort_as_table3(points, m).rank == non_dominated_ranks(points, m);
  }
  rows.push_back(judge({"T3", "Table 3", "fronts by its steps and by the sort in use are the same", "yes"},
                       fmt::format("{} of {} sets", same, kSets), same == kSets,
                       {"60 random points with ties in 2, 3 and 4 objectives", "", ""}));
  const double by_n = growth(comparisons(200, 2, seed), comparisons(400, 2, seed), 2);
  const double by_m = growth(comparisons(200, 2, seed), comparisons(200, 4, seed), 2);
  rows.push_back(
      judge({"S32.O(N2)", "Section 3.2", "exponent of N in the cost of the non-dominated sort", "2"},
            fmt::format("{:.2f}", by_n), std::abs(by_n - 2) < 0.05,
            {"comparisons of objective values by Table 3, N = 200 and 400", "",
             "for the paper's fixed number of objectives; the sort in use takes O(N log N) for two"}));
  rows.push_back(judge({"S32.O(N2).M", "Section 3.2", "exponent of the number of objectives M in O(N²)", "0"},
                       fmt::format("{:.2f}", by_m), std::abs(by_m) < 0.05,
                       {"the same for M = 2 and 4", "the sort is O(M N²)", ""}));
  rows.push_back(row_of_conflict(seed));
  return rows;
}

}  // namespace asterism
