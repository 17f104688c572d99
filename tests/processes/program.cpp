// SPDX-License-Identifier: Apache-2.0
// Optimises a test problem in all processes that were started and prints the marks of the fronts; run.py
// compares them. `program fail` lets the evaluation fail in the last process, `program input` its input.
#include <fmt/format.h>

#include <string>

#include "asterism/core/result.hpp"
#include "asterism/optimization/problems_for_tests.hpp"
#include "processes.hpp"

namespace {

using namespace asterism;

void run(const std::string& how) {
  app::Processes processes;
  const auto good = problems::unit_cube("ZDT1", 30, 2, 0, problems::zdt1);
  const auto bad = problems::unit_cube("bad", 1, 2, 0, [](problems::In x, problems::Out, problems::Out) {
    if (x[0] > 0.9) throw InputError("a gene of more than 0.9 is too much");
  });
  const OptimizationProblem& problem = how == "fail" ? static_cast<const OptimizationProblem&>(bad) : good;
  processes.together([&] {
    if (how == "input" && !processes.leads()) throw InputError("cell.toml", "cannot be read");
  });
  OptimizerOptions options;
  options.generations = 30;
  options.migration_interval = 7;
  options.islands = how == "islands" ? 3 : 1;
  if (!processes.leads()) return processes.serve(problem, options);
  const OptimizationResult result = optimize(problem, options, {}, processes.workers(problem, options));
  fmt::print("{:016x} {:016x}\n", result.front_checksum, checksum(result.population));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc > 1 ? argv[1] : "");
  } catch (const app::Processes::Dismissed&) {
    return 0;
  } catch (const InputError& error) {
    fmt::print("refused: {}\n", error.what());
  }
}
