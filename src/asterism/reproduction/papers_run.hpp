// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "asterism/optimization/optimizer.hpp"
#include "asterism/optimization/real_problem.hpp"
#include "asterism/reproduction/verdict.hpp"

namespace asterism {

/// The problem of the paper's Section 4.2: four targets, x and y within ± 700 mm, z within 580 to 620 mm;
/// least mean distance to the origin against largest sum of pair distances. Its five schemes are in the
/// first population.
class PapersProblem final : public RealProblem {
 public:
  PapersProblem();
  [[nodiscard]] std::string identity() const override;
  [[nodiscard]] std::vector<ObjectiveInfo> objectives() const override;
  [[nodiscard]] std::vector<Genes> seeds() const override;
  void evaluate(std::span<const double> genes, std::span<double> objectives,
                std::span<double> violations) const override;
};

/// The optimisation the paper times: 50 candidates, 100 generations, Tables 3 to 7.
[[nodiscard]] OptimizationResult papers_run(std::uint64_t seed);

/// 13.7 s, 200 ms and the settings of that run. Times are measured now and differ from run to run.
[[nodiscard]] std::vector<LedgerRow> rows_of_times(std::uint64_t seed);

}  // namespace asterism
