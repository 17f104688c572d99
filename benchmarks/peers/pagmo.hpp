// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asterism/optimization/real_problem.hpp"

namespace asterism::bench {

/// What an engine made of a problem.
struct PeerRun {
  std::vector<double> objectives;  // of its last population, row-major
  std::vector<Genes> genes;        // of the same
  double cpu_seconds = 0;          // of this process; making the first population included
  std::string refusal;             // why it did not run
};

/// pagmo's nsga2 with SBX 20, 0.9 and polynomial mutation 20, 1/n. ZDT and DTLZ2 are evaluated by pagmo's own
/// code, other problems by `evaluate`; seeds enter the first population.
[[nodiscard]] PeerRun pagmo_nsga2(const RealProblem& problem, int population, int generations, unsigned seed);

[[nodiscard]] std::string pagmo_version();

/// A mark of an archipelago's result: the sum of ZDT1's second objective over four islands along a ring, all
/// seeds fixed.
[[nodiscard]] double pagmo_archipelago_mark();

/// CPU seconds of this process, all threads.
[[nodiscard]] double cpu_seconds();

}  // namespace asterism::bench
