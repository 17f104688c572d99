// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "asterism/core/random.hpp"

namespace asterism {

/// What one candidate is made of: numbers whose meaning only the problem knows. Their count may vary.
using Genes = std::vector<double>;

/// An objective; all are minimised. `unit` is empty for a pure number.
struct ObjectiveInfo {
  std::string name;
  std::string unit;
};

/// A constraint: its violation is 0 when it holds, else how much is missing, in its unit. Violations are
/// added up after division by `scale`, the amount that counts as much as one of any other constraint.
struct ConstraintInfo {
  std::string name;
  std::string unit;
  double scale = 1;
};

/// What is to be minimised. All of it is a pure function of the arguments and may be called from several
/// threads at once.
class OptimizationProblem {
 public:
  virtual ~OptimizationProblem() = default;

  /// Tells this problem from every other: a resumed run refuses a checkpoint of another one.
  [[nodiscard]] virtual std::string identity() const = 0;
  [[nodiscard]] virtual std::vector<ObjectiveInfo> objectives() const = 0;
  [[nodiscard]] virtual std::vector<ConstraintInfo> constraints() const { return {}; }

  /// A candidate at random, for the first population.
  [[nodiscard]] virtual Genes sample(RandomStream& random) const = 0;
  /// Candidates known to be good; they enter the first population before the random ones.
  [[nodiscard]] virtual std::vector<Genes> seeds() const { return {}; }
  /// Two children of two parents: crossover, mutation and repair.
  virtual void vary(std::span<const double> mother, std::span<const double> father, Genes& daughter,
                    Genes& son, RandomStream& random) const = 0;
  /// Writes each objective, and each constraint's violation (0 or more).
  virtual void evaluate(std::span<const double> genes, std::span<double> objectives,
                        std::span<double> violations) const = 0;
  /// Candidates of one niche compete with one another only, so that each number of targets keeps members.
  [[nodiscard]] virtual std::size_t niche_of(std::span<const double> genes) const {
    static_cast<void>(genes);
    return 0;
  }
};

}  // namespace asterism
