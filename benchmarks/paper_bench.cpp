// SPDX-License-Identifier: Apache-2.0
// How long the paper takes: its Monte Carlo of lost targets (1000 draws of three schemes) and its
// optimisation (50 candidates, 100 generations; 13.7 s in MATLAB by its Section 4.3).

#include <fmt/format.h>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/layout/target_loss.hpp"
#include "asterism/reproduction/papers_run.hpp"
#include "asterism/reproduction/reproduce.hpp"
#include "bench.hpp"

int main() {
  using namespace asterism;
  std::vector<Layout> layouts;
  for (const PublishedLayout& layout : paper_table1()) layouts.push_back(layout.targets);
  const auto draw = [&] { static_cast<void>(figures_of(draw_target_loss(layouts, {}, 1000, 1))); };
  const auto enumerate = [&] { static_cast<void>(expect_target_loss(layouts, {}, 1000)); };
  const auto optimise = [] { static_cast<void>(papers_run(1)); };
  const auto everything = [] { static_cast<void>(reproduce_paper(1)); };

  bench::Table table("The paper's computations", {"what", "threads", "median ms"});
  for (const int threads : {1, 0}) {
    set_thread_count(threads);
    const std::string count = threads == 0 ? "all" : "1";
    const auto row = [&](const char* what, const std::function<void()>& call, int repeats) {
      table.row({what, count, fmt::format("{:.3f}", 1e3 * bench::median_seconds(call, repeats))});
    };
    row("lost targets: 1000 draws of 3 schemes (goal 2 ms)", draw, 15);
    row("lost targets: expectations over all sets", enumerate, 15);
    row("optimisation, 50 candidates, 100 generations", optimise, 15);
    row("every table and figure", everything, 3);
  }
  table.print_json();
}
