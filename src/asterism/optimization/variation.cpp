// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/variation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kSameGene = 1e-14;  // parents nearer than this have one gene, as in Deb's code

/// In (0, 1), never 0, so that roots and inverses of it are finite.
double open_uniform(RandomStream& random) { return (static_cast<double>(random.bits()) + 0.5) * 0x1.0p-32; }

/// Where the distribution of a child's spread is cut off by a bound `room` away from the outer parent:
/// twice its area up to there. Below `far`, apart/(apart + 2 room) is too small to matter.
double area_within(double apart, double room, int power, double far) {
  const double reach = apart + 2 * room;
  return apart < far * reach ? 2 : 2 - integer_power(apart / reach, power);
}

/// How far a child lies from the middle of its parents, in half their distance.
double spread(double area, const IntegerRoot& root) {
  const bool inside = area <= 1;
  const double factor = root(inside ? area : 2 - area);
  return inside ? factor : 1 / factor;
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
      mutation_root_(options.mutation_index + 1),
      far_(crossover_root_(0x1p-54)) {}

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
  if (random.uniform() >= options_.crossover_probability) return;
  const int power = options_.crossover_index + 1;
  for (std::size_t block = 0; block < count; block += 32) {
    std::uint32_t crossing = random.bits();
    const std::uint32_t swapping = random.bits();
    if (count - block < 32) crossing &= (std::uint32_t{1} << (count - block)) - 1;
    for (; crossing != 0; crossing &= crossing - 1) {
      const int bit = std::countr_zero(crossing);
      const std::size_t i = block + static_cast<std::size_t>(bit);
      const double low = std::min(mother[i], father[i]);
      const double high = std::max(mother[i], father[i]);
      const double apart = high - low;
      if (!(apart > kSameGene)) continue;
      const double u = open_uniform(random);
      const double area_below = area_within(apart, low - lowest[i], power, far_);
      const double area_above = area_within(apart, highest[i] - high, power, far_);
      const double below = spread(u * area_below, crossover_root_);
      const double above = area_above == area_below ? below : spread(u * area_above, crossover_root_);
      const double lower = std::clamp(0.5 * (low + high - below * apart), lowest[i], highest[i]);
      const double upper = std::clamp(0.5 * (low + high + above * apart), lowest[i], highest[i]);
      const bool swap = ((swapping >> bit) & 1) != 0;
      daughter[i] = swap ? upper : lower;
      son[i] = swap ? lower : upper;
    }
  }
}

void Variation::mutate(std::span<double> genes, std::span<const double> lowest,
                       std::span<const double> highest, RandomStream& random) const {
  const std::size_t count = genes.size();
  if (count == 0) return;
  const double spared = 1 - std::min(1.0, options_.mutations / static_cast<double>(count));
  const double four_spared = spared * spared * (spared * spared);
  const int power = options_.mutation_index + 1;
  for (std::size_t i = 0;; ++i) {
    // One number tells how many genes are spared until the next mutation.
    const double u = random.uniform();
    double all_spared = 1;
    for (; u < all_spared * four_spared && i < count; i += 4) all_spared *= four_spared;
    for (; u < all_spared * spared && i < count; ++i) all_spared *= spared;
    if (i >= count) return;
    const double range = highest[i] - lowest[i];
    const double v = open_uniform(random);
    if (range > 0) {
      const double gene = std::clamp(genes[i], lowest[i], highest[i]);
      const bool down = v < 0.5;
      const double room = (down ? gene - lowest[i] : highest[i] - gene) / range;
      const double side = down ? 2 * v : 2 * (1 - v);
      const double step = 1 - mutation_root_(side + (1 - side) * integer_power(1 - room, power));
      genes[i] = std::clamp(gene + (down ? -step : step) * range, lowest[i], highest[i]);
    }
  }
}

}  // namespace asterism
