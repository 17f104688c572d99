// SPDX-License-Identifier: Apache-2.0
// Set cover against the best known covers: every 4-cycle of an n-cube hit (CYC n) and the points that hit
// every triple of a Steiner system (STS n), all and 90 % of them. With an argument: problems of the
// OR-Library's form read from files, such as those that plan_bench writes.
#include <fmt/format.h>

#include <ctime>
#include <string>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/optimization/cover_problems_for_tests.hpp"
#include "asterism/optimization/cover_text.hpp"
#include "bench.hpp"

using namespace asterism;

namespace {

constexpr std::uint64_t kSeed = 2026;

void add_row(bench::Table& table, const std::string& name, const SetCoverProblem& problem,
             const SetCoverOptions& options, const std::string& best_known) {
  const std::clock_t begin = std::clock();
  const SetCover cover = solve(problem, options, kSeed, no_progress);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  table.row({name, fmt::format("{}", problem.rows), fmt::format("{}", problem.columns.size()),
             fmt::format("{} x {}", cover.rows_left, cover.columns_left),
             fmt::format("{:.6g}", cover.greedy_cost), fmt::format("{:.6g}", cover.local_cost),
             fmt::format("{:.6g}", cover.cost), fmt::format("{:.6g}", cover.bound),
             cover.optimal ? "yes" : "no", best_known, fmt::format("{:.2f}", seconds), cover.exact});
}

void cubes(bench::Table& table) {
  // full: OR-Library and RWLS; 90 %: the partial covers published by TAU-AUTOlab
  struct Known {
    int n, full, partial, steps;
  };
  for (const Known& known :
       {Known{6, 60, 48, 1000000}, {7, 144, 119, 1000000}, {8, 342, 280, 4000000}, {9, 772, 652, 8000000}}) {
    SetCoverProblem problem = cube_cycles(known.n);
    const SetCoverOptions options{known.steps, 0, 0, true};  // CBC gains nothing over the dual here
    add_row(table, fmt::format("CYC{}", known.n), problem, options, fmt::format("{}", known.full));
    problem.share = 0.9;
    add_row(table, fmt::format("CYC{} 90 %", known.n), problem, options, fmt::format("{}", known.partial));
  }
}

void steiner_systems(bench::Table& table) {
  const std::pair<std::uint32_t, int> known[] = {{9, 5}, {15, 9}, {27, 18}, {45, 30}, {81, 61}};
  for (const auto& [points, best] : known)
    add_row(table, fmt::format("STS{}", points), steiner_cover(points), {100000, 5, 0, true},
            fmt::format("{}", best));
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Table table("Set cover", {"problem", "rows", "columns", "reduced", "greedy", "local", "ours",
                                   "bound", "optimal", "best known", "cpu s", "exact part"});
  for (int k = 1; k < count; ++k)
    add_row(table, arguments[k], cover_problem_of(read_file(arguments[k]), arguments[k]), {}, "-");
  if (count == 1) {
    cubes(table);
    steiner_systems(table);
  }
  table.print_json();
  return 0;
} catch (const InputError& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
