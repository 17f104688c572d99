// SPDX-License-Identifier: Apache-2.0
// How good and how fast the optimiser is, beside pagmo, DEAP and GNU Octave in the same run: known fronts,
// the paper's problem of Section 4.2, constraints, and whether a run can be repeated. Times are CPU seconds
// of one thread's work, medians with quartiles; engines take turns seed by seed.
//   optimizer_bench [SEEDS]      31 seeds unless told
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>

#include "asterism/core/parallel.hpp"
#include "asterism/optimization/hypervolume.hpp"
#include "asterism/optimization/optimizer.hpp"
#include "asterism/optimization/problems_for_tests.hpp"
#include "asterism/reproduction/papers_run.hpp"
#include "bench.hpp"
#include "peers/pagmo.hpp"

namespace asterism::bench {
namespace {

std::vector<double> objectives_of(const std::vector<Candidate>& candidates) {
  std::vector<double> objectives;
  for (const Candidate& candidate : candidates) {
    if (std::ranges::all_of(candidate.violations, [](double v) { return v == 0; }))
      objectives.insert(objectives.end(), candidate.objectives.begin(), candidate.objectives.end());
  }
  return objectives;
}

struct Samples {
  std::vector<double> cpu, hypervolume;
};

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}
double median(const std::vector<double>& values) { return quantile(values, 0.5); }
std::string milliseconds(const std::vector<double>& cpu) {
  return fmt::format("{:.1f} ({:.1f}..{:.1f})", 1e3 * median(cpu), 1e3 * quantile(cpu, 0.25),
                     1e3 * quantile(cpu, 0.75));
}

/// One-sided Mann–Whitney: how likely `ours` would be so much above `theirs` by chance (normal approximation
/// with continuity, fair from eight samples on).
double chance_of_being_better(const std::vector<double>& ours, const std::vector<double>& theirs) {
  double wins = 0;
  for (const double a : ours) {
    for (const double b : theirs) wins += a > b ? 1 : a == b ? 0.5 : 0;
  }
  const double n = static_cast<double>(ours.size()), k = static_cast<double>(theirs.size());
  const double z = (wins - n * k / 2 - 0.5) / std::sqrt(n * k * (n + k + 1) / 12);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

struct Engine {
  std::string name;
  std::function<PeerRun(const RealProblem&, unsigned seed)> run;
};

PeerRun run_ours(const RealProblem& problem, OptimizerOptions options, unsigned seed) {
  options.seed = seed;
  PeerRun run;
  const double start = cpu_seconds();
  const OptimizationResult result = optimize(problem, options);
  run.cpu_seconds = cpu_seconds() - start;
  run.objectives = objectives_of(result.population);
  return run;
}

std::vector<Engine> engines(int population, int pagmos_population, int generations) {
  const auto ours = [=](OptimizerOptions options) {
    options.population = population;
    options.generations = generations;
    return [options](const RealProblem& problem, unsigned seed) { return run_ours(problem, options, seed); };
  };
  OptimizerOptions no_archive;
  no_archive.archive = false;
  return {{"deb2002", ours(deb2002())},
          {"no archive", ours(no_archive)},
          {"default", ours({})},
          {"pagmo nsga2", [=](const RealProblem& problem, unsigned seed) {
             return pagmo_nsga2(problem, pagmos_population, generations, seed);
           }}};
}

std::vector<Samples> sample(const RealProblem& problem, const std::vector<Engine>& all,
                            const std::vector<double>& reference, int seeds) {
  std::vector<Samples> samples(all.size());
  for (unsigned seed = 1; seed <= static_cast<unsigned>(seeds); ++seed) {
    for (std::size_t e = 0; e < all.size(); ++e) {
      const PeerRun run = all[e].run(problem, seed);
      samples[e].cpu.push_back(run.cpu_seconds);
      samples[e].hypervolume.push_back(hypervolume(run.objectives, reference.size(), reference));
    }
  }
  return samples;
}

void tell(Table& table, const std::string& problem, const std::vector<Engine>& all,
          const std::vector<Samples>& samples) {
  const Samples& pagmo = samples.back();
  for (std::size_t e = 0; e < all.size(); ++e) {
    const auto& [cpu, volumes] = samples[e];
    table.row({problem, all[e].name, milliseconds(cpu),
               fmt::format("{:.1f}", median(pagmo.cpu) / median(cpu)), fmt::format("{:.5g}", median(volumes)),
               fmt::format("{:.5g}..{:.5g}", quantile(volumes, 0), quantile(volumes, 1)),
               fmt::format("{:.1e}", chance_of_being_better(volumes, pagmo.hypervolume))});
  }
}

const std::vector<std::string> kColumns{"problem",     "engine",   "CPU ms",        "x pagmo",
                                        "hypervolume", "from..to", "p (not better)"};

void known_fronts(int seeds) {
  Table table(fmt::format("Known fronts: 100 candidates, 250 generations, {} seeds; hypervolume up to 1.1 in "
                          "each objective; pagmo {}",
                          seeds, pagmo_version()),
              kColumns);
  const std::vector<Engine> all = engines(100, 100, 250);
  for (const auto& problem : problems::unconstrained()) {
    const std::vector<double> reference(problem.objectives().size(), 1.1);
    tell(table, problem.identity(), all, sample(problem, all, reference, seeds));
  }
  table.print_json();
}

/// What a program prints: CPU seconds, then a line of objectives for each candidate.
PeerRun run_program(const std::string& command) {
  PeerRun run;
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  std::string text;
  for (int c = 0; pipe != nullptr && (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  if (pipe == nullptr || pclose(pipe) != 0) run.refusal = "did not run: " + command;
  std::istringstream numbers(text);
  numbers >> run.cpu_seconds;
  for (double value = 0; numbers >> value;) run.objectives.push_back(value);
  return run;
}

void papers_problem(int seeds) {
  Table table(
      fmt::format("The paper's problem (Section 4.2): 50 candidates (pagmo and DEAP 52), 100 "
                  "generations, {} seeds; hypervolume in mm² up to (1200, 0); Octave runs Tables 3-7, once",
                  seeds),
      kColumns);
  const PapersProblem problem;
  std::vector<Engine> all = engines(50, 52, 100);
  std::vector<Samples> samples = sample(problem, all, {1200, 0}, seeds);
  const std::string scripts = ASTERISM_PEERS;
  Samples deap, octave;
  for (int seed = 1; seed <= 5; ++seed) {
    const PeerRun run = run_program(fmt::format("/usr/bin/python3 {}/deap_nsga2.py paper {}", scripts, seed));
    if (!run.refusal.empty()) break;
    deap.cpu.push_back(run.cpu_seconds);
    deap.hypervolume.push_back(hypervolume(run.objectives, 2, std::vector<double>{1200, 0}));
  }
  const PeerRun run = run_program(fmt::format("octave-cli --no-gui -q {}/paper_nsga2.m 50 100 1", scripts));
  if (run.refusal.empty()) {
    octave.cpu.push_back(run.cpu_seconds);
    octave.hypervolume.push_back(hypervolume(run.objectives, 2, std::vector<double>{1200, 0}));
  }
  for (const auto& [name, peer] : {std::pair("DEAP", &deap), std::pair("Octave", &octave)}) {
    if (peer->cpu.empty()) continue;
    all.insert(all.end() - 1, Engine{name, {}});
    samples.insert(samples.end() - 1, *peer);
  }
  tell(table, "four targets", all, samples);
  table.print_json();
}

/// Best mean distance 580 mm (all at (0, 0, 580)) and best sum of distances 9562.08 mm (corners, z in turn).
void papers_extremes() {
  Table table("The paper's problem: extremes found, mm (the best there are: 580 and 9562.08)",
              {"run", "mean distance", "sum of pairs"});
  for (const auto& [population, generations] :
       {std::pair(50, 100), std::pair(200, 500), std::pair(400, 2000)}) {
    OptimizerOptions options;
    options.population = population;
    options.generations = generations;
    double nearest = 1e9, widest = 0;
    for (const Candidate& candidate : optimize(PapersProblem(), options).front) {
      nearest = std::min(nearest, candidate.objectives[0]);
      widest = std::max(widest, -candidate.objectives[1]);
    }
    table.row({fmt::format("{} x {}", population, generations), fmt::format("{:.2f}", nearest),
               fmt::format("{:.2f}", widest)});
  }
  table.print_json();
}

/// Known corners beyond each front, in the order of problems::constrained().
const std::vector<std::vector<double>> kBeyondConstrained{
    {140, 50}, {250, 0}, {1.2, 1.2}, {0, 80}, {0.55, 0.55, 0.55}, {1.1, 1.1, 1.1}, {2.2, 2.2, 2.2}};

void constraints() {
  Table table("Constraints: 100 candidates, 250 generations (C1-DTLZ1 500), hypervolume of the feasible ones",
              {"problem", "feasible", "archive", "hypervolume", "CPU ms", "pagmo nsga2"});
  const std::vector<problems::FormulaProblem> all = problems::constrained();
  for (std::size_t i = 0; i < all.size(); ++i) {
    OptimizerOptions options;
    if (all[i].identity() == "C1-DTLZ1") options.generations = 500;
    const double start = cpu_seconds();
    const OptimizationResult result = optimize(all[i], options);
    const double cpu = cpu_seconds() - start;
    const std::vector<double>& beyond = kBeyondConstrained[i];
    const std::string refusal = pagmo_nsga2(all[i], 100, 10, 1).refusal;
    table.row({all[i].identity(), fmt::format("{:.0f} %", 100 * result.history.back().feasible_share),
               fmt::format("{}", result.front.size()),
               fmt::format("{:.6g}", hypervolume(objectives_of(result.population), beyond.size(), beyond)),
               fmt::format("{:.1f}", 1e3 * cpu), refusal.empty() ? "ran" : refusal});
  }
  table.print_json();
}

void repetition() {
  Table table("The same again: four islands along a ring, marks of the fronts",
              {"engine", "repetitions", "different results"});
  const auto problem = problems::unit_cube("ZDT1", 30, 2, 0, problems::zdt1);
  OptimizerOptions options;
  options.islands = 4;
  options.generations = 100;
  options.migration_interval = 10;
  std::set<std::uint64_t> ours;
  for (const int threads : {1, 2, 4, 1, 2, 4}) {
    set_thread_count(threads);
    ours.insert(optimize(problem, options).front_checksum);
  }
  set_thread_count(0);
  std::set<double> theirs;
  for (int i = 0; i < 6; ++i) theirs.insert(pagmo_archipelago_mark());
  table.row({"asterism", "6 (1, 2, 4 threads)", fmt::format("{}", ours.size())});
  table.row({"pagmo archipelago", "6", fmt::format("{}", theirs.size())});
  table.print_json();
}

}  // namespace
}  // namespace asterism::bench

int main(int argc, char** argv) {
  using namespace asterism::bench;
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 31;
  known_fronts(seeds);
  papers_problem(seeds);
  papers_extremes();
  constraints();
  repetition();
}
