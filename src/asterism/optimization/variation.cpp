// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/variation.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kSameGene = 1e-14;  // parents nearer than this have one gene, as in Deb's code

/// In (0, 1), never 0, so that roots and inverses of it are finite; 32 bits are fine enough for a mutation.
double open_uniform(RandomStream& random) { return (static_cast<double>(random.bits()) + 0.5) * 0x1.0p-32; }

/// Genes that cross, at most 32 at a time.
struct alignas(kLanesAlignment) Crossing {
  static constexpr std::size_t kMost = 32;
  std::array<DoubleLanes, kMost / kDoubleLanes> low, high;        // the parents'
  std::array<DoubleLanes, kMost / kDoubleLanes> lowest, highest;  // bounds
  std::array<DoubleLanes, kMost / kDoubleLanes> u;                // random, in (0, 1)
  std::array<DoubleLanes, kMost / kDoubleLanes> lower, upper;     // the children's

  void set(std::size_t k, double mother, double father, double bottom, double top, double random) {
    const std::size_t block = k / kDoubleLanes, lane = k % kDoubleLanes;
    low[block][lane] = std::min(mother, father);
    high[block][lane] = std::max(mother, father);
    lowest[block][lane] = bottom;
    highest[block][lane] = top;
    u[block][lane] = random;
  }
};

/// How far a child lies from the middle of its parents, in half their distance, when they are `apart` and
/// a bound lies `room` beyond the outer one.
ASTERISM_INLINE DoubleLanes spread(DoubleLanes u, DoubleLanes apart, DoubleLanes room, int power,
                                   const IntegerRoot& root) {
  const DoubleLanes area = u * (2 - integer_power(apart / (apart + 2 * room), power));
  const DoubleLanes factor = root(area <= 1 ? area : 2 - area);
  return area <= 1 ? factor : 1 / factor;
}

ASTERISM_CLONES void make_children(Crossing& c, std::size_t blocks, int power, const IntegerRoot& root) {
  for (std::size_t i = 0; i < blocks; ++i) {
    const DoubleLanes apart = c.high[i] - c.low[i];
    const DoubleLanes sum = c.low[i] + c.high[i];
    const DoubleLanes below = spread(c.u[i], apart, c.low[i] - c.lowest[i], power, root);
    const DoubleLanes above = spread(c.u[i], apart, c.highest[i] - c.high[i], power, root);
    const DoubleLanes lower = 0.5 * (sum - below * apart);
    const DoubleLanes upper = 0.5 * (sum + above * apart);
    // Rounding may carry them out of their bounds, even across: each is held to both.
    const DoubleLanes raised = lower > c.lowest[i] ? lower : c.lowest[i];
    const DoubleLanes capped = upper < c.highest[i] ? upper : c.highest[i];
    c.lower[i] = raised < c.highest[i] ? raised : c.highest[i];
    c.upper[i] = capped > c.lowest[i] ? capped : c.lowest[i];
  }
}

}  // namespace

void describe(VariationOptions& options, OptionVisitor& visit) {
  visit.choice_of("crossover", options.crossover, {"simulated-binary", "paper-average"},
                  "how two parents make children; paper-average takes their mean and can only contract");
  visit.number("crossover_probability", options.crossover_probability, {0, 1}, "share of pairs that cross");
  visit.integer("crossover_index", options.crossover_index, {0, 500}, "higher: children nearer to parents");
  visit.number("mutations", options.mutations, {0, 1e6}, "genes of a child that mutate, on average");
  visit.integer("mutation_index", options.mutation_index, {0, 500}, "higher: smaller mutations");
}

Variation::Variation(const VariationOptions& options)
    : options_(options),
      crossover_root_(options.crossover_index + 1),
      mutation_root_(options.mutation_index + 1) {}

void Variation::cross(std::span<const double> mother, std::span<const double> father,
                      std::span<const double> lowest, std::span<const double> highest,
                      std::vector<double>& daughter, std::vector<double>& son, RandomStream& random) const {
  const std::size_t count = mother.size();
  require(father.size() == count && lowest.size() == count && highest.size() == count,
          "parents have a gene for each bound");
  daughter.assign(mother.begin(), mother.end());
  son.assign(father.begin(), father.end());
  if (options_.crossover == Crossover::PaperAverage) {
    for (std::size_t i = 0; i < count; ++i) daughter[i] = son[i] = 0.5 * (mother[i] + father[i]);
    return;
  }
  if (open_uniform(random) >= options_.crossover_probability) return;
  Crossing crossing;
  std::array<std::size_t, Crossing::kMost> gene;
  for (std::size_t first = 0; first < count; first += Crossing::kMost) {
    std::uint32_t chosen = random.bits();
    const std::uint32_t swapped = random.bits();
    if (count - first < Crossing::kMost) chosen &= (std::uint32_t{1} << (count - first)) - 1;
    std::size_t crossing_genes = 0;
    for (; chosen != 0; chosen &= chosen - 1) {
      const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(chosen));
      if (!(std::abs(mother[i] - father[i]) > kSameGene)) continue;
      gene[crossing_genes] = i;
      crossing.set(crossing_genes++, mother[i], father[i], lowest[i], highest[i], open_uniform(random));
    }
    const std::size_t blocks = (crossing_genes + kDoubleLanes - 1) / kDoubleLanes;
    for (std::size_t k = crossing_genes; k < blocks * kDoubleLanes; ++k) crossing.set(k, 0, 1, 0, 1, 0.5);
    make_children(crossing, blocks, options_.crossover_index + 1, crossover_root_);
    for (std::size_t k = 0; k < crossing_genes; ++k) {
      const double lower = crossing.lower[k / kDoubleLanes][k % kDoubleLanes];
      const double upper = crossing.upper[k / kDoubleLanes][k % kDoubleLanes];
      const bool swap = ((swapped >> (gene[k] - first)) & 1) != 0;
      daughter[gene[k]] = swap ? upper : lower;
      son[gene[k]] = swap ? lower : upper;
    }
  }
}

void Variation::mutate(std::span<double> genes, std::span<const double> lowest,
                       std::span<const double> highest, RandomStream& random) const {
  const std::size_t count = genes.size();
  if (count == 0) return;
  const double spared = 1 - std::min(1.0, options_.mutations / static_cast<double>(count));
  const double four_spared = spared * spared * (spared * spared);
  for (std::size_t i = 0;; ++i) {
    // One number tells how many genes are spared until the next mutation.
    const double u = open_uniform(random);
    double all_spared = 1;
    for (; u < all_spared * four_spared && i < count; i += 4) all_spared *= four_spared;
    for (; u < all_spared * spared && i < count; ++i) all_spared *= spared;
    if (i >= count) return;
    const double range = highest[i] - lowest[i];
    const double v = 2 * open_uniform(random);
    if (!(range > 0)) continue;
    const double gene = std::clamp(genes[i], lowest[i], highest[i]);
    // Down with v in (0, 1), up with v in (1, 2); without a branch that nobody could foretell.
    const double way = v < 1 ? -1 : 1;
    const double side = std::min(v, 2 - v);
    const double room = (v < 1 ? gene - lowest[i] : highest[i] - gene) / range;
    const double step =
        1 - mutation_root_(side + (1 - side) * integer_power(1 - room, options_.mutation_index + 1));
    genes[i] = std::clamp(gene + way * step * range, lowest[i], highest[i]);
  }
}

}  // namespace asterism
