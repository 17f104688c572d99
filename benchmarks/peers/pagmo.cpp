// SPDX-License-Identifier: Apache-2.0
#include "pagmo.hpp"

#include <algorithm>
#include <ctime>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/archipelago.hpp>
#include <pagmo/config.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/problems/dtlz.hpp>
#include <pagmo/problems/zdt.hpp>
#include <pagmo/topologies/ring.hpp>

namespace asterism::bench {
namespace {

/// One of ours as pagmo sees problems; inequality constraints are to be ≤ 0.
struct Wrapped {
  const RealProblem* problem = nullptr;

  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    pagmo::vector_double all(get_nobj() + get_nic());
    problem->evaluate(x, std::span(all).first(get_nobj()), std::span(all).subspan(get_nobj()));
    return all;
  }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {problem->lowest(), problem->highest()};
  }
  [[nodiscard]] pagmo::vector_double::size_type get_nobj() const { return problem->objectives().size(); }
  [[nodiscard]] pagmo::vector_double::size_type get_nic() const { return problem->constraints().size(); }
};

pagmo::problem pagmo_problem(const RealProblem& problem) {
  const std::string name = problem.identity();
  const auto genes = static_cast<unsigned>(problem.lowest().size());
  if (name.starts_with("ZDT")) return pagmo::problem(pagmo::zdt(static_cast<unsigned>(name[3] - '0'), genes));
  if (name.starts_with("DTLZ2")) return pagmo::problem(pagmo::dtlz(2, genes, problem.objectives().size()));
  return pagmo::problem(Wrapped{&problem});
}

}  // namespace

PeerRun pagmo_nsga2(const RealProblem& problem, int population, int generations, unsigned seed) {
  const double genes = static_cast<double>(problem.lowest().size());
  PeerRun run;
  const double start = cpu_seconds();
  try {
    const pagmo::algorithm algorithm(
        pagmo::nsga2(static_cast<unsigned>(generations), 0.9, 20., 1 / genes, 20., seed));
    const std::vector<Genes> seeds = problem.seeds();
    pagmo::population people(pagmo_problem(problem), static_cast<unsigned>(population) - seeds.size(), seed);
    for (const Genes& known : seeds) people.push_back(known);
    people = algorithm.evolve(people);
    run.cpu_seconds = cpu_seconds() - start;
    for (const pagmo::vector_double& f : people.get_f())
      run.objectives.insert(run.objectives.end(), f.begin(), f.end());
    run.genes = people.get_x();
  } catch (const std::exception& error) {
    // Of its message, what says why: "…what: Non linear constraints detected in NAME instance…".
    const std::string message = error.what();
    const std::size_t why = message.find("what: ");
    run.refusal = message.substr(why == std::string::npos ? 0 : why + 6);
    run.refusal.resize(std::min(run.refusal.size(), run.refusal.find(" in ")));
  }
  return run;
}

std::string pagmo_version() { return PAGMO_VERSION; }

double pagmo_archipelago_mark() {
  pagmo::archipelago islands(pagmo::ring{});
  for (unsigned i = 0; i < 4; ++i) {
    const pagmo::algorithm algorithm(pagmo::nsga2(10, 0.9, 20., 1. / 30, 20., i + 1));
    islands.push_back(algorithm, pagmo::population(pagmo::problem(pagmo::zdt(1, 30)), 40, i + 1));
  }
  islands.set_migrant_handling(pagmo::migrant_handling::preserve);
  islands.evolve(10);
  islands.wait_check();
  double mark = 0;
  for (const pagmo::island& island : islands) {
    const pagmo::population people = island.get_population();
    for (const pagmo::vector_double& f : people.get_f()) mark += f[1];
  }
  return mark;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace asterism::bench
