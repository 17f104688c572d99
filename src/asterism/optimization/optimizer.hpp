// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/optimization/optimizer_options.hpp"
#include "asterism/optimization/optimizer_state.hpp"
#include "asterism/optimization/problem.hpp"

namespace asterism {

/// Evaluates candidates; `objectives` and `violations` are row-major, one row a candidate. Whoever
/// distributes the work fills the same rows, so that the results do not depend on it.
using BatchEvaluator = std::function<void(const OptimizationProblem& problem, std::span<const Genes> genes,
                                          std::span<double> objectives, std::span<double> violations)>;

/// On this process's threads, or on one where the work is too little to share.
void evaluate_batch(const OptimizationProblem& problem, std::span<const Genes> genes,
                    std::span<double> objectives, std::span<double> violations);

/// Carries islands on by so many generations, each on its own, wherever that is done.
using IslandRunner = std::function<void(std::span<IslandState> islands, int generations)>;

/// What is done to each of them: a pure function of its arguments.
void advance_island(const OptimizationProblem& problem, const OptimizerOptions& options, IslandState& island,
                    int generations);

/// Who does the work when it is not this process's threads; empty = they do. With `run_islands`,
/// `evaluate` is not called.
struct OptimizerWorkers {
  BatchEvaluator evaluate;
  IslandRunner run_islands;
};

enum class StopReason { Generations, Evaluations, Time, Stagnation };
[[nodiscard]] std::string words(StopReason reason);

/// A constraint that the closest of all candidates breaks.
struct ConstraintShortfall {
  ConstraintInfo constraint;
  double violation = 0;  // in its unit
};

struct OptimizationResult {
  std::vector<Candidate> population;  // all islands'
  std::vector<Candidate> front;       // feasible and non-dominated: of the archive, else of the population
  std::vector<GenerationRecord> history;
  std::optional<StopReason> stopped;  // empty while it could go on
  std::uint64_t front_checksum = 0;
  // Where no candidate was feasible: the one that broke the constraints least, and by how much.
  Candidate closest;
  std::vector<ConstraintShortfall> shortfalls;
};

/// "no candidate holds all constraints; the closest breaks `visible targets` by 1" or empty.
[[nodiscard]] std::string infeasibility(const OptimizationResult& result);

/// NSGA-II and its descendants, a generation at a time. Random numbers are keyed by (seed, island,
/// generation, individual, purpose): any number of threads or processes and any interruption between two
/// steps give the same bits. Throws InputError when an objective is not a finite number.
class Optimizer {
 public:
  Optimizer(const OptimizationProblem& problem, const OptimizerOptions& options,
            OptimizerWorkers workers = {});
  ~Optimizer();
  Optimizer(const Optimizer&) = delete;
  Optimizer& operator=(const Optimizer&) = delete;

  /// The next generation; with several islands, all up to the next exchange.
  void step();
  [[nodiscard]] bool finished() const;

  [[nodiscard]] OptimizerState state() const;
  /// Goes on from there. Throws InputError for the state of another problem or of other options.
  void restore(const OptimizerState& state);

  [[nodiscard]] const std::vector<GenerationRecord>& history() const;
  /// At the pace so far and by the nearest limit, stagnation left aside.
  [[nodiscard]] double seconds_left() const;
  [[nodiscard]] OptimizationResult result() const;

 private:
  struct Run;
  std::unique_ptr<Run> run_;
};

/// Called after each step: draws progress, writes checkpoints; throws to stop.
using OnGeneration = std::function<void(const Optimizer& optimizer)>;

[[nodiscard]] OptimizationResult optimize(const OptimizationProblem& problem, const OptimizerOptions& options,
                                          const OnGeneration& on_generation = {},
                                          const OptimizerWorkers& workers = {});

}  // namespace asterism
