// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/optimization/problem.hpp"
#include "asterism/optimization/variation.hpp"

namespace asterism {

/// A problem whose genes are a fixed number of bounded reals. What is left to say is its identity, its
/// objectives and constraints, and `evaluate`.
class RealProblem : public OptimizationProblem {
 public:
  RealProblem(std::vector<double> lowest, std::vector<double> highest, const VariationOptions& options = {});

  [[nodiscard]] Genes sample(RandomStream& random) const override;
  void vary(std::span<const double> mother, std::span<const double> father, Genes& daughter, Genes& son,
            RandomStream& random) const override;

  [[nodiscard]] const std::vector<double>& lowest() const { return lowest_; }
  [[nodiscard]] const std::vector<double>& highest() const { return highest_; }

 private:
  std::vector<double> lowest_, highest_;
  Variation variation_;
};

}  // namespace asterism
