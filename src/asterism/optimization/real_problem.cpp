// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/real_problem.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "asterism/core/result.hpp"

namespace asterism {

RealProblem::RealProblem(std::vector<double> lowest, std::vector<double> highest,
                         const VariationOptions& options)
    : lowest_(std::move(lowest)), highest_(std::move(highest)), variation_(options) {
  require(lowest_.size() == highest_.size(), "each gene has two bounds");
  for (std::size_t i = 0; i < lowest_.size(); ++i) {
    if (!(std::isfinite(lowest_[i]) && std::isfinite(highest_[i]) && lowest_[i] <= highest_[i]))
      throw InputError(fmt::format("gene {} has the bounds {} and {}: the first must not exceed the second",
                                   i + 1, lowest_[i], highest_[i]));
  }
}

Genes RealProblem::sample(RandomStream& random) const {
  Genes genes(lowest_.size());
  for (std::size_t i = 0; i < genes.size(); ++i) genes[i] = random.uniform(lowest_[i], highest_[i]);
  return genes;
}

void RealProblem::vary(std::span<const double> mother, std::span<const double> father, Genes& daughter,
                       Genes& son, RandomStream& random) const {
  variation_.cross(mother, father, lowest_, highest_, daughter, son, random);
  variation_.mutate(daughter, lowest_, highest_, random);
  variation_.mutate(son, lowest_, highest_, random);
}

}  // namespace asterism
