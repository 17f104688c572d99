// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/optimizer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/optimization/hypervolume.hpp"
#include "asterism/optimization/problems_for_tests.hpp"

namespace asterism {
namespace {

problems::FormulaProblem zdt1() { return problems::unit_cube("ZDT1", 30, 2, 0, problems::zdt1); }

double hypervolume_of(const std::vector<Candidate>& candidates, const std::vector<double>& reference) {
  std::vector<double> objectives;
  for (const Candidate& candidate : candidates)
    objectives.insert(objectives.end(), candidate.objectives.begin(), candidate.objectives.end());
  return hypervolume(objectives, reference.size(), reference);
}

template <class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no refusal";
}

// ZDT1's front is f2 = 1 − √f1: up to (1.1, 1.1) all of it has the hypervolume 0.8762, a hundred points about
// 0.872 at best.
TEST(Optimize, FindsTheFrontOfZdt1) {
  const OptimizationResult result = optimize(zdt1(), {});
  EXPECT_EQ(result.population.size(), 100U);
  EXPECT_GT(hypervolume_of(result.population, {1.1, 1.1}), 0.8710);
  EXPECT_LT(hypervolume_of(result.population, {1.1, 1.1}), 0.8722);
  EXPECT_GT(result.front.size(), 500U);
  EXPECT_GT(hypervolume_of(result.front, {1.1, 1.1}), 0.8735);
  for (const Candidate& candidate : result.front)
    EXPECT_NEAR(candidate.objectives[1], 1 - std::sqrt(candidate.objectives[0]), 0.02);
  EXPECT_EQ(result.stopped, StopReason::Generations);
  EXPECT_TRUE(infeasibility(result).empty());
}

TEST(Optimize, FindsTheFrontOfZdt1AsTheTextbookDoes) {
  const OptimizationResult result = optimize(zdt1(), deb2002());
  EXPECT_GT(hypervolume_of(result.population, {1.1, 1.1}), 0.868);
  EXPECT_LE(result.front.size(), 100U);
  EXPECT_EQ(result.history.back().evaluations, 25100);
}

TEST(Optimize, FindsTheSphereOfDtlz2InThreeObjectives) {
  const auto problem = problems::unit_cube("DTLZ2", 12, 3, 0, problems::dtlz2);
  const OptimizationResult result = optimize(problem, {});
  for (const Candidate& candidate : result.population) {
    double radius = 0;
    for (const double f : candidate.objectives) radius += f * f;
    EXPECT_NEAR(std::sqrt(radius), 1, 0.05);
  }
}

// From four objectives on reference points choose, and the hypervolume is told every tenth generation.
TEST(Optimize, FindsTheSphereOfDtlz2InFiveObjectives) {
  const auto problem = problems::unit_cube("DTLZ2", 14, 5, 0, problems::dtlz2);
  const OptimizationResult result = optimize(problem, {});
  for (const Candidate& candidate : result.population) {
    double radius = 0;
    for (const double f : candidate.objectives) radius += f * f;
    EXPECT_NEAR(std::sqrt(radius), 1, 0.12);
  }
  EXPECT_EQ(result.history[249].hypervolume, result.history[240].hypervolume);
  EXPECT_GT(result.history[250].hypervolume, result.history[10].hypervolume);
}

// Each whole part of the gene is a niche; the others are dominated by the first and live all the same.
TEST(Optimize, LetsEveryNicheKeepMembers) {
  class Niches : public RealProblem {
   public:
    Niches() : RealProblem({0}, {3.999}) {}
    [[nodiscard]] std::string identity() const override { return "niches"; }
    [[nodiscard]] std::vector<ObjectiveInfo> objectives() const override { return {{"f1", ""}, {"f2", ""}}; }
    void evaluate(std::span<const double> x, std::span<double> f, std::span<double>) const override {
      const double part = x[0] - std::floor(x[0]);
      f[0] = std::floor(x[0]) + part;
      f[1] = std::floor(x[0]) + 1 - part;
    }
    [[nodiscard]] std::size_t niche_of(std::span<const double> x) const override {
      return static_cast<std::size_t>(x[0]);
    }
  };
  OptimizerOptions options;
  options.population = 40;
  options.generations = 30;
  std::vector<int> members(4);
  for (const Candidate& candidate : optimize(Niches(), options).population)
    ++members[static_cast<std::size_t>(candidate.genes[0])];
  EXPECT_EQ(members, (std::vector<int>{10, 10, 10, 10}));
}

// C-DTLZ1's feasible share of the space is tiny; that it is entered at all is the test.
TEST(Optimize, FindsFeasibleFronts) {
  for (const auto& problem : problems::constrained()) {
    OptimizerOptions options;
    options.population = 92;
    options.generations = problem.identity() == "C1-DTLZ1" ? 400 : 150;
    const OptimizationResult result = optimize(problem, options);
    EXPECT_EQ(result.history.back().feasible_share, 1) << problem.identity();
    EXPECT_GT(result.front.size(), 50U) << problem.identity();
    for (const Candidate& candidate : result.front)
      EXPECT_EQ(*std::ranges::max_element(candidate.violations), 0) << problem.identity();
  }
}

TEST(Optimize, GivesTheSameBitsForAnyNumberOfThreads) {
  OptimizerOptions options;
  options.generations = 40;
  options.islands = 3;
  options.migration_interval = 7;
  std::vector<std::uint64_t> marks;
  for (const int threads : {1, 2, 4}) {
    set_thread_count(threads);
    marks.push_back(optimize(zdt1(), options).front_checksum);
  }
  set_thread_count(0);
  EXPECT_EQ(marks[1], marks[0]);
  EXPECT_EQ(marks[2], marks[0]);
  options.seed = 2;
  EXPECT_NE(optimize(zdt1(), options).front_checksum, marks[0]);
}

TEST(Optimize, GivesTheSameBitsWhereverItsIslandsAreAdvanced) {
  OptimizerOptions options;
  options.generations = 30;
  options.islands = 2;
  options.migration_interval = 6;
  const auto problem = zdt1();
  OptimizerWorkers elsewhere;
  elsewhere.run_islands = [&](std::span<IslandState> islands, int generations) {
    for (IslandState& island : islands) {
      island = island_state_from_bytes(to_bytes(island));
      advance_island(problem, options, island, generations);
    }
  };
  OptimizerWorkers evaluator;
  evaluator.evaluate = evaluate_batch;
  const auto mark = optimize(problem, options).front_checksum;
  EXPECT_EQ(optimize(problem, options, {}, elsewhere).front_checksum, mark);
  EXPECT_EQ(optimize(problem, options, {}, evaluator).front_checksum, mark);
}

TEST(Optimizer, GoesOnWithTheSameBitsFromItsState) {
  for (const auto& problem : {zdt1(), problems::constrained()[3]}) {
    for (const int islands : {1, 3}) {
      OptimizerOptions options;
      options.generations = 30;
      options.islands = islands;
      options.migration_interval = 4;
      const OptimizationResult whole = optimize(problem, options);
      Optimizer first(problem, options);
      for (int i = 0; i < 5; ++i) first.step();
      Optimizer second(problem, options);
      second.restore(optimizer_state_from_bytes(to_bytes(first.state())));
      while (!second.finished()) second.step();
      EXPECT_EQ(second.result().front_checksum, whole.front_checksum);
      EXPECT_EQ(checksum(second.result().population), checksum(whole.population));
      ASSERT_EQ(second.history().size(), whole.history.size());
      for (std::size_t i = 0; i < whole.history.size(); ++i)
        EXPECT_EQ(second.history()[i].hypervolume, whole.history[i].hypervolume);
    }
  }
}

TEST(Optimizer, RefusesTheStateOfAnotherProblemOrOtherOptions) {
  const auto problem = zdt1();
  Optimizer optimizer(problem, {});
  optimizer.step();
  const OptimizerState state = optimizer.state();
  const auto other = problems::make_zdt4();
  EXPECT_EQ(refusal_of([&] { Optimizer(other, {}).restore(state); }),
            "the run to go on with was of another problem: ZDT1; this one is ZDT4");
  OptimizerOptions larger;
  larger.population = 120;
  EXPECT_TRUE(refusal_of([&] {
                Optimizer(problem, larger).restore(state);
              }).starts_with("the run to go on with had other options: population 100, "));
  OptimizerOptions longer;
  longer.generations = 1000;  // how long it runs may be changed
  Optimizer goes_on(problem, longer);
  goes_on.restore(state);
  EXPECT_EQ(goes_on.history().size(), 1U);
}

TEST(Optimizer, StopsByEvaluationsTimeAndStagnation) {
  OptimizerOptions options;
  options.evaluations = 1050;
  EXPECT_EQ(optimize(zdt1(), options).stopped, StopReason::Evaluations);
  EXPECT_EQ(optimize(zdt1(), options).history.back().generation, 10);
  options = {};
  options.generations = 1000000;
  options.seconds = 0.02;
  EXPECT_EQ(optimize(zdt1(), options).stopped, StopReason::Time);
  options.seconds = 0;
  options.stagnation_generations = 20;
  const OptimizationResult result = optimize(zdt1(), options);
  EXPECT_EQ(result.stopped, StopReason::Stagnation);
  EXPECT_GT(hypervolume_of(result.population, {1.1, 1.1}), 0.870);
}

TEST(Optimizer, TellsHowFarItIs) {
  const auto problem = zdt1();
  OptimizerOptions options;
  options.generations = 50;
  double last = 0;
  int calls = 0;
  const auto result = optimize(problem, options, [&](const Optimizer& optimizer) {
    ++calls;
    const GenerationRecord& now = optimizer.history().back();
    EXPECT_EQ(now.generation, calls - 1);
    EXPECT_GE(now.hypervolume, last - 1e-12);  // survival by contribution never loses any of two objectives
    EXPECT_EQ(now.feasible_share, 1);
    EXPECT_GE(optimizer.seconds_left(), 0);
    last = now.hypervolume;
  });
  EXPECT_EQ(calls, 51);
  EXPECT_EQ(result.history.size(), 51U);
}

problems::FormulaProblem with(problems::FormulaProblem::Formula formula, std::size_t constraints = 0) {
  return problems::unit_cube("own", 2, 2, constraints, formula);
}

TEST(Optimize, RefusesAnObjectiveThatIsNoNumber) {
  const auto nan = with([](problems::In, problems::Out f, problems::Out) {
    f[0] = 1;
    f[1] = std::numeric_limits<double>::quiet_NaN();
  });
  EXPECT_EQ(refusal_of([&] { (void)optimize(nan, {}); }),
            "objective `f2` of candidate 1 in generation 0 is nan: it must be a finite number");
  const auto infinite = with([](problems::In x, problems::Out f, problems::Out) {
    f[0] = x[0];
    f[1] = 1 / (x[0] - x[0]);
  });
  EXPECT_EQ(refusal_of([&] { (void)optimize(infinite, {}); }),
            "objective `f2` of candidate 1 in generation 0 is inf: it must be a finite number");
  const auto negative = with(
      [](problems::In x, problems::Out f, problems::Out v) {
        f[0] = f[1] = x[0];
        v[0] = -1;
      },
      1);
  EXPECT_EQ(
      refusal_of([&] { (void)optimize(negative, {}); }),
      "the violation of `g1` of candidate 1 in generation 0 is -1: it must be 0 or a finite number above");
}

TEST(Optimize, NamesTheConstraintThatNobodyHolds) {
  const auto impossible = with(
      [](problems::In x, problems::Out f, problems::Out v) {
        f[0] = x[0];
        f[1] = 1 - x[0];
        v[0] = problems::missing(x[0] - 1.25);  // at least 0.25 is missing
        v[1] = 0;
      },
      2);
  OptimizerOptions options;
  options.generations = 60;
  const OptimizationResult result = optimize(impossible, options);
  EXPECT_TRUE(result.front.empty());
  EXPECT_EQ(result.history.back().feasible_share, 0);
  ASSERT_EQ(result.shortfalls.size(), 1U);
  EXPECT_NEAR(result.shortfalls[0].violation, 0.25, 1e-9);
  EXPECT_EQ(infeasibility(result), "no candidate holds all constraints; the closest misses `g1` by 0.25");
}

// Three values of one gene are all there is: nothing new can be bred, and that is no error.
TEST(Optimize, EndsWhereTheSearchSpaceIsExhausted) {
  class Three : public OptimizationProblem {
   public:
    [[nodiscard]] std::string identity() const override { return "three"; }
    [[nodiscard]] std::vector<ObjectiveInfo> objectives() const override { return {{"x", ""}}; }
    [[nodiscard]] Genes sample(RandomStream& random) const override {
      return {static_cast<double>(random.below(3))};
    }
    void vary(std::span<const double>, std::span<const double>, Genes& daughter, Genes& son,
              RandomStream& random) const override {
      daughter = sample(random);
      son = sample(random);
    }
    void evaluate(std::span<const double> x, std::span<double> f, std::span<double>) const override {
      f[0] = x[0];
    }
  };
  OptimizerOptions options;
  options.population = 10;
  options.generations = 5;
  const OptimizationResult result = optimize(Three(), options);
  ASSERT_EQ(result.front.size(), 1U);
  EXPECT_EQ(result.front[0].genes, Genes{0});
}

TEST(OptimizerOptions, AreHeldToTheirLimits) {
  OptimizerOptions options;
  options.population = 1;
  EXPECT_EQ(refusal_of([&] { check(options); }), "`population` is 1; it must lie between 2 and 1000000");
  options.population = 4;
  options.islands = 2;
  EXPECT_EQ(refusal_of([&] { check(options); }), "migrants is 5 but a population has only 4 candidates");
}

TEST(OptimizerState, RefusesDamagedBytes) {
  const std::string bytes = to_bytes(OptimizerState{});
  EXPECT_EQ(to_bytes(optimizer_state_from_bytes(bytes)), bytes);
  for (const std::string& damaged : {bytes.substr(0, bytes.size() - 1), bytes + "x", std::string("\xff\xff")})
    EXPECT_EQ(refusal_of([&] { (void)optimizer_state_from_bytes(damaged); }),
              "the state of the optimiser is damaged");
}

}  // namespace
}  // namespace asterism
