// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/core/options.hpp"
#include "asterism/core/random.hpp"
#include "asterism/optimization/integer_root.hpp"

namespace asterism {

enum class Crossover {
  SimulatedBinary,  // Deb & Agrawal 1995, bounded
  PaperAverage,     // the paper's Eq. 30: every child is the mean of its parents. It can only contract.
};

struct VariationOptions {
  Crossover crossover = Crossover::SimulatedBinary;
  double crossover_probability = 0.9;  // of a pair of parents
  int crossover_index = 20;            // the higher, the nearer are children to their parents
  double mutations = 1;                // genes of a child that mutate, on average
  int mutation_index = 20;
};

void describe(VariationOptions& options, OptionVisitor& visit);

/// Bounded simulated binary crossover (each gene of a crossing pair with probability ½, children swapped
/// with probability ½) and bounded polynomial mutation, as in Deb's own code and the paper's Tables 5 and 6.
/// Own arithmetic only, so that every machine gives the same bits.
class Variation {
 public:
  explicit Variation(const VariationOptions& options = {});

  /// Children have the length of their parents. `daughter` and `son` are resized.
  void cross(std::span<const double> mother, std::span<const double> father, std::span<const double> lowest,
             std::span<const double> highest, std::vector<double>& daughter, std::vector<double>& son,
             RandomStream& random) const;
  void mutate(std::span<double> genes, std::span<const double> lowest, std::span<const double> highest,
              RandomStream& random) const;

 private:
  VariationOptions options_;
  IntegerRoot crossover_root_, mutation_root_;  // x^(1/(index + 1))
};

}  // namespace asterism
