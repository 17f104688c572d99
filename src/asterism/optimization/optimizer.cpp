// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/optimizer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "asterism/core/result.hpp"
#include "asterism/optimization/hypervolume.hpp"
#include "asterism/optimization/island.hpp"
#include "asterism/optimization/non_dominated_sort.hpp"
#include "asterism/optimization/share_work.hpp"

namespace asterism {
namespace {

/// With many objectives a hypervolume costs more than a generation, so it is brought up to date seldom.
constexpr std::size_t kManyObjectives = 4;
constexpr int kHypervolumeInterval = 10;

bool comes_first(const Candidate& a, const Candidate& b) {
  return a.objectives < b.objectives || (a.objectives == b.objectives && a.genes < b.genes);
}

/// Of `candidates` the non-dominated, in lexicographic order of their objectives.
std::vector<Candidate> non_dominated(std::vector<Candidate> candidates, std::size_t m) {
  std::vector<double> objectives;
  for (const Candidate& candidate : candidates)
    objectives.insert(objectives.end(), candidate.objectives.begin(), candidate.objectives.end());
  std::vector<Candidate> front;
  const std::vector<int> ranks = non_dominated_ranks(objectives, m);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (ranks[i] == 0) front.push_back(std::move(candidates[i]));
  }
  for (Candidate& candidate : front) candidate.rank = 0;
  std::ranges::sort(front, comes_first);
  return front;
}

}  // namespace

void evaluate_batch(const OptimizationProblem& problem, std::span<const Genes> genes,
                    std::span<double> objectives, std::span<double> violations) {
  if (genes.empty()) return;
  const std::size_t m = objectives.size() / genes.size(), c = violations.size() / genes.size();
  share_work(genes.size(), [&](std::size_t i) {
    problem.evaluate(genes[i], objectives.subspan(i * m, m), violations.subspan(i * c, c));
  });
}

void advance_island(const OptimizationProblem& problem, const OptimizerOptions& options, IslandState& island,
                    int generations) {
  Island advanced(problem, options, {}, island.index);
  advanced.restore(std::move(island));
  advanced.advance(generations);
  island = advanced.state();
}

struct Optimizer::Run {
  Run(const OptimizationProblem& asked, const OptimizerOptions& chosen, OptimizerWorkers by)
      : problem(asked), options(chosen), workers(std::move(by)), m(asked.objectives().size()) {
    check(options);
    require(m > 0, "a problem has an objective");
    for (int i = 0; i < options.islands; ++i)
      islands.push_back(std::make_unique<Island>(problem, options, workers.evaluate, i));
  }

  void advance(int generations);
  void migrate();
  void record(double seconds);
  [[nodiscard]] std::vector<double> front_objectives() const;
  [[nodiscard]] double hypervolume_of_front();
  [[nodiscard]] int generation() const { return history.empty() ? -1 : history.back().generation; }
  [[nodiscard]] bool stagnates() const;
  void tell_closest(OptimizationResult& result) const;
  [[nodiscard]] std::optional<StopReason> stop_reason() const;

  const OptimizationProblem& problem;
  OptimizerOptions options;
  OptimizerWorkers workers;
  std::size_t m;
  std::vector<std::unique_ptr<Island>> islands;
  std::vector<double> reference;
  std::vector<GenerationRecord> history;
};

/// Islands know nothing of each other until they migrate, so they may be advanced at the same time; an
/// evaluator given by the caller is asked for one batch at a time.
void Optimizer::Run::advance(int generations) {
  if (workers.run_islands) {
    std::vector<IslandState> states;
    for (const auto& island : islands) states.push_back(island->state());
    workers.run_islands(states, generations);
    for (std::size_t i = 0; i < islands.size(); ++i) islands[i]->restore(std::move(states[i]));
  } else if (workers.evaluate) {
    for (const auto& island : islands) island->advance(generations);
  } else {
    share_work(islands.size(), [&](std::size_t i) { islands[i]->advance(generations); });
  }
}

/// Along a ring; all leave before anybody arrives.
void Optimizer::Run::migrate() {
  std::vector<std::vector<Candidate>> sent;
  for (const auto& island : islands)
    sent.push_back(island->emigrants(static_cast<std::size_t>(options.migrants)));
  for (std::size_t i = 0; i < islands.size(); ++i)
    islands[(i + 1) % islands.size()]->receive(std::move(sent[i]));
}

std::vector<double> Optimizer::Run::front_objectives() const {
  std::vector<double> objectives;
  for (const auto& island : islands) {
    const IslandState& state = island->population();
    for (std::size_t i = 0; i < state.genes.size(); ++i) {
      if (state.rank[i] != 0 || !island->is_feasible(i)) continue;
      const auto first = state.objectives.begin() + static_cast<std::ptrdiff_t>(i * m);
      objectives.insert(objectives.end(), first, first + static_cast<std::ptrdiff_t>(m));
    }
  }
  return objectives;
}

/// The reference lies a tenth of the first feasible candidates' extent beyond the worst of them.
double Optimizer::Run::hypervolume_of_front() {
  if (m >= kManyObjectives && generation() >= 0 && (generation() + 1) % kHypervolumeInterval != 0)
    return history.back().hypervolume;
  if (reference.empty()) {
    std::vector<double> best(m, std::numeric_limits<double>::infinity());
    std::vector<double> worst(m, -std::numeric_limits<double>::infinity());
    bool any = false;
    for (const auto& island : islands) {
      const IslandState& state = island->population();
      for (std::size_t i = 0; i < state.genes.size(); ++i) {
        if (!island->is_feasible(i)) continue;
        any = true;
        for (std::size_t k = 0; k < m; ++k) {
          best[k] = std::min(best[k], state.objectives[i * m + k]);
          worst[k] = std::max(worst[k], state.objectives[i * m + k]);
        }
      }
    }
    if (!any) return 0;
    for (std::size_t k = 0; k < m; ++k)
      reference.push_back(worst[k] + (worst[k] > best[k] ? 0.1 * (worst[k] - best[k]) : 1.0));
  }
  return hypervolume(front_objectives(), m, reference);
}

void Optimizer::Run::record(double seconds) {
  GenerationRecord now;
  now.hypervolume = hypervolume_of_front();
  now.generation = islands.front()->population().generation;
  std::size_t feasible = 0, all = 0;
  for (const auto& island : islands) {
    now.evaluations += island->population().evaluations;
    all += island->population().genes.size();
    for (std::size_t i = 0; i < island->population().genes.size(); ++i) feasible += island->is_feasible(i);
  }
  now.feasible_share = static_cast<double>(feasible) / static_cast<double>(all);
  now.seconds = (history.empty() ? 0 : history.back().seconds) + seconds;
  history.push_back(now);
}

bool Optimizer::Run::stagnates() const {
  const int span = options.stagnation_generations;
  if (span == 0 || generation() < span || reference.empty()) return false;
  const auto before = std::ranges::find_if(history.rbegin(), history.rend(), [&](const GenerationRecord& r) {
    return r.generation <= generation() - span;
  });
  return before->hypervolume > 0 &&
         history.back().hypervolume <= before->hypervolume * (1 + options.stagnation_gain);
}

std::optional<StopReason> Optimizer::Run::stop_reason() const {
  if (history.empty()) return {};
  const GenerationRecord& now = history.back();
  if (now.generation >= options.generations) return StopReason::Generations;
  if (options.evaluations > 0 && now.evaluations >= options.evaluations) return StopReason::Evaluations;
  if (options.seconds > 0 && now.seconds >= options.seconds) return StopReason::Time;
  if (stagnates()) return StopReason::Stagnation;
  return {};
}

Optimizer::Optimizer(const OptimizationProblem& problem, const OptimizerOptions& options,
                     OptimizerWorkers workers)
    : run_(std::make_unique<Run>(problem, options, std::move(workers))) {}

Optimizer::~Optimizer() = default;

void Optimizer::step() {
  const auto start = std::chrono::steady_clock::now();
  const int before = run_->generation();
  const int interval = run_->options.islands > 1 ? run_->options.migration_interval : 1;
  const int left = std::max(1, run_->options.generations - before);
  if (before >= 0 && run_->options.islands > 1) run_->migrate();
  run_->advance(before < 0 ? 1 : std::min(interval, left));
  run_->record(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

bool Optimizer::finished() const { return run_->stop_reason().has_value(); }

const std::vector<GenerationRecord>& Optimizer::history() const { return run_->history; }

double Optimizer::seconds_left() const {
  if (run_->history.empty()) return 0;
  const GenerationRecord& now = run_->history.back();
  const OptimizerOptions& options = run_->options;
  const double per_generation = now.seconds / (now.generation + 1);
  double left = per_generation * (options.generations - now.generation);
  if (options.evaluations > 0)
    left = std::min(left, now.seconds * (static_cast<double>(options.evaluations) /
                                             static_cast<double>(std::max(1LL, now.evaluations)) -
                                         1));
  if (options.seconds > 0) left = std::min(left, options.seconds - now.seconds);
  return std::max(0.0, left);
}

OptimizerState Optimizer::state() const {
  OptimizerState state;
  state.problem = run_->problem.identity();
  state.options = identity(run_->options);
  for (const auto& island : run_->islands) state.islands.push_back(island->state());
  state.reference = run_->reference;
  state.history = run_->history;
  return state;
}

void Optimizer::restore(const OptimizerState& state) {
  const std::string problem = run_->problem.identity(), options = identity(run_->options);
  if (state.problem != problem)
    throw InputError(fmt::format("the run to go on with was of another problem: {}; this one is {}",
                                 state.problem, problem));
  if (state.options != options)
    throw InputError(
        fmt::format("the run to go on with had other options: {}; now they are {}", state.options, options));
  if (state.islands.size() != run_->islands.size()) throw InputError("the state of the optimiser is damaged");
  for (std::size_t i = 0; i < state.islands.size(); ++i) run_->islands[i]->restore(state.islands[i]);
  run_->reference = state.reference;
  run_->history = state.history;
}

OptimizationResult Optimizer::result() const {
  OptimizationResult result;
  std::vector<Candidate> feasible;
  for (const auto& island : run_->islands) {
    for (std::size_t i = 0; i < island->population().genes.size(); ++i) {
      result.population.push_back(island->candidate(i));
      if (!run_->options.archive && island->is_feasible(i)) feasible.push_back(island->candidate(i));
    }
    std::vector<Candidate> archive = island->archive();
    std::ranges::move(archive, std::back_inserter(feasible));
  }
  const bool is_front = run_->options.archive && run_->islands.size() == 1;
  result.front = is_front ? std::move(feasible) : non_dominated(std::move(feasible), run_->m);
  result.front_checksum = checksum(result.front);
  result.history = run_->history;
  result.stopped = run_->stop_reason();
  run_->tell_closest(result);
  return result;
}

/// Where no island has ever seen a feasible candidate.
void Optimizer::Run::tell_closest(OptimizationResult& result) const {
  const std::vector<ConstraintInfo> constraints = problem.constraints();
  const Candidate* nearest = nullptr;
  for (const auto& island : islands) {
    const Candidate& closest = island->population().closest;
    if (closest.objectives.empty()) return;
    if (nearest == nullptr ||
        total_violation(closest.violations, constraints) < total_violation(nearest->violations, constraints))
      nearest = &closest;
  }
  result.closest = *nearest;
  for (std::size_t c = 0; c < constraints.size(); ++c) {
    if (nearest->violations[c] > 0) result.shortfalls.push_back({constraints[c], nearest->violations[c]});
  }
}

OptimizationResult optimize(const OptimizationProblem& problem, const OptimizerOptions& options,
                            const OnGeneration& on_generation, const OptimizerWorkers& workers) {
  Optimizer optimizer(problem, options, workers);
  while (!optimizer.finished()) {
    optimizer.step();
    if (on_generation) on_generation(optimizer);
  }
  return optimizer.result();
}

}  // namespace asterism
