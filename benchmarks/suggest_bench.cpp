// SPDX-License-Identifier: Apache-2.0
// The loop closed: a poor layout, bettered one target at a time by what `asterism layout suggest` says,
// beside the best that the designer finds for as many targets when it may place them all; and what a
// suggestion costs.

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "asterism/core/parallel.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/layout/cell_for_tests.hpp"
#include "asterism/layout/designer.hpp"
#include "asterism/layout/suggestion.hpp"
#include "bench.hpp"

namespace asterism::bench {
namespace {

using Q = LayoutQuantity;

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Suggestion suggested(const Cell& cell, const SuggestOptions& options) {
  LayoutModel model(cell, designer_options(options));
  model.present = model.completed(model.present);
  return suggest_changes(model, {}, options);
}

/// The least worst error after one loss that the designer finds with so many targets.
std::optional<double> designers_best(Cell cell, std::size_t targets, const std::string& constraints) {
  cell.layout->fewest = cell.layout->most = static_cast<int>(targets);
  DesignerOptions options;
  options.objectives = "worst-error-1-lost, identifiability";
  options.constraints = constraints;
  const DesignResult result = design_layouts(cell, options);
  std::optional<double> best;
  for (const LayoutDesign& design : result.front) {
    const auto error = design.value_of(Q::WorstErrorOneLost);
    if (error && (!best || *error < *best)) best = error;
  }
  return best;
}

void close_the_loop(const std::string& title, Cell cell, const std::string& constraints) {
  SuggestOptions options;
  options.kinds = "move";
  options.constraints = constraints;
  Table table(title, {"after moves", "1 lost mm", "visible", "moved", "way mm", "wall s", "CPU s"});
  auto& targets = cell.movers[0].body.targets;
  const std::size_t count = targets.size();
  std::string moved, way;
  for (int moves = 0; moves <= 8; ++moves) {
    const double wall = seconds_of(CLOCK_MONOTONIC), cpu = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    const Suggestion next = suggested(cell, options);
    const auto& error = next.present.error_mm;
    table.row({fmt::format("{}", moves), error ? fmt::format("{:.4f}", *error) : "none",
               fmt::format("{}", next.present.visible), moved, way,
               fmt::format("{:.2f}", seconds_of(CLOCK_MONOTONIC) - wall),
               fmt::format("{:.2f}", seconds_of(CLOCK_PROCESS_CPUTIME_ID) - cpu)});
    if (!next.best) break;
    moved = next.best->id;
    way = fmt::format("{:.0f}", next.best->way_mm);
    targets = next.best->targets;
  }
  const auto best = designers_best(cell, count, constraints);
  table.row({"the designer's best", best ? fmt::format("{:.4f}", *best) : "none", "", "", "", "", ""});
  table.print_json();
}

Cell with_layout(Cell cell, const std::vector<Vec3>& places) {
  auto& targets = cell.movers[0].body.targets;
  targets.clear();
  for (const Vec3& place : places) {
    Target target;
    target.id = fmt::format("P{}", targets.size() + 1);
    target.position = place;
    targets.push_back(target);
  }
  return cell;
}

}  // namespace
}  // namespace asterism::bench

int main() {
  using namespace asterism::bench;
  using asterism::paper_cell;
  const auto& poor = asterism::paper_table9()[0].targets;
  close_the_loop("Table 9's S1, four targets within 700 mm, all seen",
                 with_layout(paper_cell(700, 200, 2600, 0), poor), "visible >= 4");
  close_the_loop("the same, told from itself by 5 mm", with_layout(paper_cell(700, 200, 2600, 0), poor),
                 "visible >= 4, identifiability >= 5");
  close_the_loop("Table 1's S1, six targets within 350 mm, all seen",
                 with_layout(paper_cell(350, 200, 2600, 0), asterism::paper_table1()[0].targets), "");
  close_the_loop("the built-in cell", asterism::cell_of("engine_casing"), "");
}
