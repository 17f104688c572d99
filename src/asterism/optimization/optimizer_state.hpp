// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asterism/optimization/problem.hpp"

namespace asterism {

/// A candidate with what the problem says of it.
struct Candidate {
  Genes genes;
  std::vector<double> objectives;  // in the problem's units, minimised
  std::vector<double> violations;  // in the constraints' units, 0 where a constraint holds
  int rank = 0;                    // 0 = of the first front
};

/// How far a run was at the end of a generation.
struct GenerationRecord {
  int generation = 0;  // 0 = the first population
  long long evaluations = 0;
  double hypervolume = 0;     // between the population's front and OptimizerState::reference
  double feasible_share = 0;  // of the population, 0 … 1
  double seconds = 0;         // spent so far, the time before a resumption included
};

/// One population and its archive between two generations. Arrays are row-major: candidate × objective.
struct IslandState {
  int index = 0;
  int generation = -1;  // −1 = not yet born
  long long evaluations = 0;
  std::vector<Genes> genes;
  std::vector<double> objectives, violations;
  std::vector<int> rank;              // with `spread`, what tournaments compare: less is better
  std::vector<double> spread;         // of equal ranks more is better
  std::vector<Candidate> immigrants;  // join in the next generation
  std::vector<Candidate> archive;     // feasible and non-dominated of all that were ever evaluated here
  Candidate closest;                  // least violating of all so far while none was feasible
};

/// A run between two generations: everything a resumed run needs to give the same bits.
struct OptimizerState {
  std::string problem;  // OptimizationProblem::identity
  std::string options;  // identity of the options
  std::vector<IslandState> islands;
  std::vector<double> reference;  // of the hypervolume; empty until a candidate is feasible
  std::vector<GenerationRecord> history;
};

/// Bytes from which the same bits come back, on any machine of this byte order.
[[nodiscard]] std::string to_bytes(const OptimizerState& state);
[[nodiscard]] OptimizerState optimizer_state_from_bytes(const std::string& bytes);
[[nodiscard]] std::string to_bytes(const IslandState& island);
[[nodiscard]] IslandState island_state_from_bytes(const std::string& bytes);

/// A mark of genes and objectives, bit for bit: equal runs show equal marks (FNV-1a, 64 bits).
[[nodiscard]] std::uint64_t checksum(const std::vector<Candidate>& candidates);

}  // namespace asterism
