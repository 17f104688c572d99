// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "asterism/optimization/optimizer.hpp"

namespace asterism::app {

/// The processes that `mpirun` or `srun` started to work on one optimisation; just this one without them.
/// The first leads: it breeds, prints and writes files. The others evaluate their share of each generation
/// or, where the options ask for several islands, carry their share of the islands on. The result has the
/// same bits for any number of them.
///
///   Processes processes;
///   processes.together([&] { … read the input … });
///   if (!processes.leads()) return processes.serve(problem, options);
///   optimize(problem, options, on_generation, processes.workers(problem, options));
class Processes {
 public:
  /// Throws InputError when several were started but this build knows no MPI.
  Processes();
  /// Dismisses the others.
  ~Processes();
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  [[nodiscard]] bool leads() const;
  [[nodiscard]] int count() const;

  /// Does the same in every process. When it fails in one, the first throws the error and the others
  /// throw Dismissed.
  void together(const std::function<void()>& work);
  struct Dismissed {};

  /// Who does the work; for the first process. `problem` and `options` must outlive them.
  [[nodiscard]] OptimizerWorkers workers(const OptimizationProblem& problem, const OptimizerOptions& options);
  /// Works for the first process until it is done; for the others, with the same problem and options.
  void serve(const OptimizationProblem& problem, const OptimizerOptions& options);

 private:
  struct Link;
  std::unique_ptr<Link> link_;  // empty where this process is alone
};

}  // namespace asterism::app
