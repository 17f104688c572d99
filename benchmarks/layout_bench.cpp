// SPDX-License-Identifier: Apache-2.0
// Where to put the targets. First the question the paper asked: a layout of each N from 4 to 12 beside its
// own eight, by the error at the part after any one loss and by the identifiability margin. Then what the
// expert's problem costs (the built-in cell: N 4 to 12, 200 poses, any one lost, ambiguity, visibility), and
// what the same number of evaluations gives when layouts are drawn at random, sought by the paper's
// objectives, or by pagmo.

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "asterism/core/parallel.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/layout/cell_for_tests.hpp"
#include "asterism/layout/designer.hpp"
#include "asterism/layout/surface.hpp"
#include "asterism/optimization/hypervolume.hpp"
#include "bench.hpp"
#include "peers/pagmo.hpp"

namespace asterism::bench {
namespace {

using Q = LayoutQuantity;

constexpr double kWorstErrorMm = 1.0;  // the hypervolume's reference, with 13 targets and no margin

double wall_seconds_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string told(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "none";
}

void tell(Table& table, const LayoutDesign& design, const std::string& verdict) {
  table.row({design.name, told(design.value_of(Q::WorstError)), told(design.value_of(Q::WorstErrorOneLost)),
             told(design.value_of(Q::Identifiability)), told(design.value_of(Q::Visible)), verdict});
}

/// Better than the best of the published in both.
bool beats_all(const LayoutDesign& design, const std::vector<LayoutDesign>& published) {
  return std::all_of(published.begin(), published.end(), [&](const LayoutDesign& other) {
    const auto error = design.value_of(Q::WorstErrorOneLost);
    const auto their_error = other.value_of(Q::WorstErrorOneLost);
    return error && (!their_error || *error < *their_error) &&
           *design.value_of(Q::Identifiability) > *other.value_of(Q::Identifiability);
  });
}

void papers_question(double radius_mm, const std::string& title) {
  const Cell cell = paper_cell(radius_mm, 200, 2600, 0);
  DesignerOptions options;
  options.objectives = "targets, worst-error-1-lost";
  options.constraints = "visible >= 4, identifiability >= 15";  // the best of the published has 14.9 mm
  options.identifiability_cap_mm = 30;
  const DesignResult result = design_layouts(cell, options);

  Table table(title, {"layout", "worst mm", "1 lost mm", "margin mm", "visible", "beats all"});
  for (const LayoutDesign& design : result.published) tell(table, design, "");
  for (std::size_t targets = 4; targets <= 12; ++targets) {
    const auto found = std::find_if(result.front.begin(), result.front.end(),
                                    [&](const LayoutDesign& d) { return d.targets.size() == targets; });
    if (found == result.front.end()) {
      table.row({fmt::format("{} targets", targets), "-", "-", "-", "-", "not found"});
    } else {
      tell(table, *found, beats_all(*found, result.published) ? "yes" : "no");
    }
  }
  table.print_json();
}

double hypervolume_of(const std::vector<LayoutDesign>& designs) {
  std::vector<double> objectives;
  for (const LayoutDesign& design : designs) {
    if (!design.feasible()) continue;
    objectives.insert(objectives.end(),
                      {static_cast<double>(design.targets.size()), *design.value_of(Q::WorstErrorOneLost),
                       -*design.value_of(Q::Identifiability)});
  }
  const std::vector<double> reference = {13, kWorstErrorMm, 0};
  return hypervolume(objectives, 3, reference);
}

/// The whole front as evaluated anew under the expert's task, whatever it was sought by.
std::vector<LayoutDesign> judged(const Cell& cell, const LayoutProblem& problem,
                                 const std::vector<Candidate>& candidates) {
  std::vector<LayoutDesign> designs(candidates.size());
  parallel_for(candidates.size(), [&](std::size_t i) {
    designs[i] = evaluate_layout(cell, problem.targets_of(candidates[i].genes), {});
  });
  return designs;
}

std::vector<LayoutDesign> drawn_at_random(const Cell& cell, const LayoutProblem& problem, int evaluations) {
  std::vector<LayoutDesign> designs(static_cast<std::size_t>(evaluations));
  parallel_for(designs.size(), [&](std::size_t i) {
    RandomStream random(1, i);
    designs[i] = evaluate_layout(cell, problem.targets_of(problem.sample(random)), {});
  });
  return designs;
}

/// The expert's problem as an engine without constraints and with a fixed number of genes can take it: so
/// many targets, each anywhere in the surface's box and brought to the nearest allowed place; what breaks a
/// constraint is added to both objectives, far above what they can be.
class FixedCount : public RealProblem {
 public:
  FixedCount(const Cell& cell, const LayoutProblem& problem, std::size_t targets)
      : RealProblem(corners(*cell.layout, targets, false), corners(*cell.layout, targets, true)),
        task_(*cell.layout),
        problem_(problem) {}

  [[nodiscard]] std::string identity() const override { return "layouts of a fixed number of targets"; }
  [[nodiscard]] std::vector<ObjectiveInfo> objectives() const override {
    return {{"worst-error-1-lost", "mm"}, {"identifiability", "mm"}};
  }
  void evaluate(std::span<const double> genes, std::span<double> objectives,
                std::span<double> /*violations*/) const override {
    const Genes placed = on_surface(genes);
    std::vector<double> values(problem_.objectives().size()), broken(problem_.constraints().size());
    problem_.evaluate(placed, values, broken);
    double penalty = 0;
    for (std::size_t i = 0; i < broken.size(); ++i) {
      penalty += 100 * broken[i] / problem_.constraints()[i].scale;
    }
    objectives[0] = values[1] + penalty;
    objectives[1] = values[2] + penalty;
  }
  [[nodiscard]] Genes on_surface(std::span<const double> genes) const {
    Genes placed(genes.begin(), genes.end());
    for (std::size_t i = 0; i < genes.size(); i += 3) {
      const auto place = nearest_allowed_place(task_.surface, {genes[i], genes[i + 1], genes[i + 2]},
                                               0.5 * task_.diameter_mm);
      if (!place) continue;
      for (std::size_t k = 0; k < 3; ++k) placed[i + k] = place->position_mm[static_cast<Eigen::Index>(k)];
    }
    return placed;
  }

 private:
  static std::vector<double> corners(const LayoutTask& task, std::size_t targets, bool highest) {
    const Bounds bounds = bounds_of(task.surface);
    const Vec3& corner = highest ? bounds.highest : bounds.lowest;
    std::vector<double> all;
    for (std::size_t i = 0; i < targets; ++i) all.insert(all.end(), corner.begin(), corner.end());
    return all;
  }
  LayoutTask task_;
  const LayoutProblem& problem_;
};

struct Timed {
  OptimizationResult found;
  double wall_s = 0, cpu_s = 0;
};
Timed timed(const LayoutProblem& problem, const OptimizerOptions& options) {
  const double wall = wall_seconds_now();
  const double cpu = cpu_seconds();
  Timed run{optimize(problem, options), 0, 0};
  run.wall_s = wall_seconds_now() - wall;
  run.cpu_s = cpu_seconds() - cpu;
  return run;
}

/// pagmo keeps one number of genes and takes no constraints: a run for each number of targets shares out the
/// evaluations.
template <class TellRun>
void pagmo_by_count(const Cell& cell, const LayoutProblem& problem, int evaluations,
                    const TellRun& tell_run) {
  constexpr int kPopulation = 40;
  const int runs = cell.layout->most - cell.layout->fewest + 1;
  const int generations = evaluations / runs / kPopulation - 1;
  Timed timing;
  const double wall = wall_seconds_now();
  std::vector<Candidate> found;
  for (int n = cell.layout->fewest; n <= cell.layout->most; ++n) {
    const FixedCount fixed(cell, problem, static_cast<std::size_t>(n));
    const PeerRun run = pagmo_nsga2(fixed, kPopulation, generations, static_cast<unsigned>(n));
    timing.cpu_s += run.cpu_seconds;
    for (const Genes& genes : run.genes) found.push_back({fixed.on_surface(genes), {}, {}, 0});
  }
  timing.wall_s = wall_seconds_now() - wall;
  tell_run(fmt::format("pagmo, {} runs, penalties", runs), &timing, judged(cell, problem, found));
}

void expert_problem(const Cell& cell) {
  set_thread_count(2);
  Table table("expert problem: built-in cell, 25,000 evaluations, 2 threads",
              {"sought by", "wall s", "CPU s", "front", "hypervolume"});
  const auto tell_run = [&](const std::string& name, const Timed* run, const std::vector<LayoutDesign>& all) {
    const auto feasible = std::count_if(all.begin(), all.end(), [](const auto& d) { return d.feasible(); });
    table.row({name, run ? fmt::format("{:.2f}", run->wall_s) : "",
               run ? fmt::format("{:.2f}", run->cpu_s) : "", fmt::format("{}", feasible),
               fmt::format("{:.3f}", hypervolume_of(all))});
  };
  OptimizerOptions options;
  options.generations = 1000;
  options.evaluations = 25000;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    options.seed = seed;
    const double wall = wall_seconds_now();
    const LayoutProblem problem(cell, {});
    const double prepared_s = wall_seconds_now() - wall;
    const Timed run = timed(problem, options);
    tell_run(fmt::format("our own, seed {}", seed), &run, judged(cell, problem, run.found.front));
    if (seed == 1) fmt::print(stderr, "(made ready, with the greedy layouts, in {:.2f} s)\n", prepared_s);
  }
  const LayoutProblem problem(cell, {});
  std::vector<LayoutDesign> greedy;
  for (const Genes& genes : problem.seeds())
    greedy.push_back(evaluate_layout(cell, problem.targets_of(genes), {}));
  tell_run("the seeds alone", nullptr, greedy);
  tell_run("25,000 at random", nullptr, drawn_at_random(cell, problem, options.evaluations));
  for (const char* objectives : {"targets, mean-spacing", "origin-distance, coverage"}) {
    DesignerOptions papers;
    papers.objectives = objectives;
    papers.constraints = "identifiability >= 0, visible >= 4";
    const LayoutProblem by_papers(cell, papers);
    const Timed run = timed(by_papers, options);
    tell_run(objectives, &run, judged(cell, by_papers, run.found.front));
  }
  pagmo_by_count(cell, problem, static_cast<int>(options.evaluations), tell_run);
  table.print_json();
  set_thread_count(0);
}

/// Median microseconds over the layouts of a finished run and as many at random, one thread.
void cost_of_a_layout(const Cell& cell) {
  set_thread_count(1);
  OptimizerOptions options;
  options.generations = 20;
  const LayoutProblem problem(cell, {});
  const LayoutModel& model = problem.model();
  std::vector<Genes> layouts;
  for (const Candidate& candidate : optimize(problem, options).population) layouts.push_back(candidate.genes);
  for (std::uint64_t i = 0; i < 100; ++i) {
    RandomStream random(2, i);
    layouts.push_back(problem.sample(random));
  }
  std::vector<double> objectives(problem.objectives().size()), violations(problem.constraints().size());
  const auto us_each = [&](const std::function<void(const Genes&)>& work) {
    const double seconds = median_seconds(
        [&] {
          for (const Genes& genes : layouts) work(genes);
        },
        5);
    return fmt::format("{:.1f}", 1e6 * seconds / static_cast<double>(layouts.size()));
  };
  Table table("cost of a layout of 5 to 12 targets, 200 poses, us", {"step", "mean us"});
  const auto margin = [&](double cap_mm) {
    return [cap_mm](const Genes& genes) {
      static_cast<void>(identifiability_margin(positions_of(genes), {4, cap_mm}));
    };
  };
  table.row({"margin, cap 10 mm", us_each(margin(10))});
  table.row({"margin, cap 1 mm", us_each(margin(1))});
  table.row({"visibility", us_each([&](const Genes& genes) {
               static_cast<void>(visible_targets(problem.targets_of(genes), model.motion, model.volume, {}));
             })});
  table.row({"two children", us_each([&](const Genes& genes) {
               RandomStream random(3, 0);
               Genes daughter, son;
               problem.vary(genes, layouts.front(), daughter, son, random);
             })});
  table.row(
      {"evaluation", us_each([&](const Genes& genes) { problem.evaluate(genes, objectives, violations); })});
  table.print_json();
  set_thread_count(0);
}

}  // namespace
}  // namespace asterism::bench

int main() {
  using namespace asterism::bench;
  papers_question(700, "any one of N lost: ours beside Tables 1 and 9, targets within 700 mm, all seen");
  papers_question(350, "the same within Table 1's 350 mm");
  const asterism::Cell cell = asterism::cell_of("engine_casing");
  cost_of_a_layout(cell);
  expert_problem(cell);
}
