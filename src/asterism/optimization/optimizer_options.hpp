// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "asterism/core/options.hpp"
#include "asterism/optimization/survival.hpp"

namespace asterism {

/// How the optimiser searches. What decides about the result (all but `generations`, `evaluations`,
/// `seconds` and the stagnation limits) belongs to a run's identity: a checkpoint made with other values is
/// refused. The number of threads or processes is no option: it changes nothing.
struct OptimizerOptions {
  int population = 100;            // candidates of each island
  int generations = 250;           // stop after so many
  int evaluations = 0;             // stop once so many candidates were evaluated; 0 = no limit
  double seconds = 0;              // stop at the next generation after so long; 0 = no limit
  int stagnation_generations = 0;  // stop when the hypervolume grew too little over so many; 0 = never
  double stagnation_gain = 1e-4;   // too little: relative growth
  Survival survival = Survival::Automatic;
  bool archive = true;            // keep every non-dominated candidate found, not only the population's
  bool remove_duplicates = true;  // a child equal to a living candidate is bred anew
  int islands = 1;                // populations that exchange candidates along a ring
  int migration_interval = 20;    // generations between exchanges
  int migrants = 5;               // candidates sent to the next island
  std::uint64_t seed = 1;
};

void describe(OptimizerOptions& options, OptionVisitor& visit);

/// NSGA-II as Deb et al. (IEEE Trans. Evol. Comput. 6(2), 2002) and the paper's Tables 3–7 state it:
/// crowding decides, nothing is archived and duplicates stay.
[[nodiscard]] OptimizerOptions deb2002();

/// Throws InputError for options that contradict one another or lie outside their limits.
void check(const OptimizerOptions& options);

/// The options that decide about the result, as one line.
[[nodiscard]] std::string identity(const OptimizerOptions& options);

}  // namespace asterism
