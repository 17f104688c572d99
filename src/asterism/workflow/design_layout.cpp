// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/design_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/core/stopwatch.hpp"
#include "asterism/io/body_file.hpp"
#include "asterism/io/checkpoint_file.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/options_file.hpp"
#include "asterism/report/layout_report.hpp"
#include "asterism/report/layout_words.hpp"

namespace asterism {
namespace {

constexpr const char* kCheckpoint = "checkpoint";

std::filesystem::path folder_of(const DesignJob& job, std::size_t number) {
  return job.out / "layouts" / fmt::format("{:02}", number);
}

void run(Optimizer& optimizer, const DesignJob& job, const GoOn& go_on, DesignedLayouts& designed) {
  const std::filesystem::path checkpoint = job.out / kCheckpoint;
  auto written = std::chrono::steady_clock::now();
  while (!optimizer.finished()) {
    if (!go_on(optimizer)) {
      designed.stopped = true;
      break;
    }
    optimizer.step();
    if (seconds_since(written) < job.checkpoint_seconds) continue;
    write_checkpoint(checkpoint, optimizer.state());
    written = std::chrono::steady_clock::now();
  }
  if (!designed.stopped) static_cast<void>(go_on(optimizer));
  if (!optimizer.history().empty()) write_checkpoint(checkpoint, optimizer.state());
}

/// The cell's bodies with the layout in place of its body's targets.
std::vector<Body> bodies_with(const Cell& cell, const LayoutDesign& design) {
  std::vector<Body> bodies = bodies_of(cell);
  for (Body& body : bodies) {
    if (body.name == cell.layout->body) body.targets = design.targets;
  }
  return bodies;
}

void write_layouts(const Cell& cell, const DesignJob& job, const DesignResult& result) {
  std::size_t number = 0;
  for (const LayoutDesign& design : result.front) {
    write_bodies(folder_of(job, ++number) / "bodies.toml", bodies_with(cell, design));
  }
  // What an earlier, longer front left would pass for a part of this one.
  std::error_code ignored;
  while (std::filesystem::remove(folder_of(job, ++number) / "bodies.toml", ignored))
    std::filesystem::remove(folder_of(job, number), ignored);
}

void write_front(const DesignJob& job, const DesignResult& result) {
  std::string text = "layout,name,knee";
  for (const LayoutQuantityInfo& info : layout_quantities()) {
    std::string column = info.name;
    std::replace(column.begin(), column.end(), '-', '_');
    text += "," + column + (info.unit == "mm" ? "_mm" : "");
  }
  text += ",given_up\n";
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    const LayoutDesign& design = result.front[i];
    text += fmt::format("{:02},{},{}", i + 1, csv_cell(design.name), static_cast<int>(i) == result.knee);
    for (const NamedValue& quantity : design.quantities)
      text += quantity.value ? fmt::format(",{:.9g}", *quantity.value) : ",";
    text += "," + csv_cell(result.given_up[i]) + "\n";
  }
  write_file(job.out / "front.csv", text);
}

std::string value_with_unit(const LayoutDesign& design, LayoutQuantity quantity) {
  const std::string& unit = info_of(quantity).unit;
  const std::optional<double> value = design.value_of(quantity);
  if (!value) return "not determined";
  return text_of_value(value) + (unit.empty() ? "" : " " + unit);
}

SummaryRow row_of(const std::string& label, const LayoutDesign& design, Verdict verdict) {
  std::string note;
  for (const NamedValue& objective : design.objectives) {
    if (!note.empty()) note += ", ";
    note += label_of_quantity(objective.name) + " " + text_of_value(objective.value);
    if (!objective.unit.empty() && objective.value) note += " " + objective.unit;
  }
  for (const std::string& broken : broken_constraints(design)) note += "; " + broken;
  return {label, value_with_unit(design, LayoutQuantity::WorstErrorOneLost), "after one loss", note, verdict};
}

std::vector<SummaryRow> rows_of(const DesignResult& result) {
  std::vector<SummaryRow> rows;
  if (result.front.empty()) {
    rows.push_back({"Layouts that hold all constraints", "0", "", result.infeasible, Verdict::Bad});
  } else {
    rows.push_back({"Layouts on the front", fmt::format("{}", result.front_found), "",
                    result.front_found > result.front.size()
                        ? fmt::format("{} of them are told here: the knee, the extremes, the most different",
                                      result.front.size())
                        : "each cannot be bettered in one objective without loss in another",
                    Verdict::Good});
    const LayoutDesign& knee = result.front[static_cast<std::size_t>(result.knee)];
    rows.push_back(row_of("Knee: " + knee.name, knee, Verdict::Good));
  }
  if (result.present) {
    const bool good = broken_constraints(*result.present).empty();
    rows.push_back(row_of("As it stands", *result.present, good ? Verdict::Plain : Verdict::Attention));
  }
  if (result.closest) rows.push_back(row_of("Closest to feasible", *result.closest, Verdict::Bad));
  if (!result.greedy.empty()) {
    double least = 1;
    for (const GreedyDesign& greedy : result.greedy) least = std::min(least, greedy.guaranteed);
    rows.push_back({"Greedy layouts", fmt::format("{:.1f}", 100 * least), "% or more",
                    "of the information that any choice of as many places could give: a proven bound",
                    Verdict::Plain});
  }
  return rows;
}

LayoutReport report_of(const Cell& cell, const DesignJob& job, const DesignedLayouts& designed) {
  const DesignResult& result = designed.result;
  LayoutReport report;
  report.title = fmt::format("Layouts of {}", cell.layout->body);
  report.subtitle =
      fmt::format("{}: {} candidates in {:.1f} s; {}", cell.name, designed.evaluations, designed.searching_s,
                  designed.stopped || !result.stopped ? "stopped before its end, can be resumed"
                                                      : "ended by " + words(*result.stopped));
  report.summary = rows_of(result);
  report.remarks = result.warnings;
  if (!result.infeasible.empty()) report.remarks.insert(report.remarks.begin(), result.infeasible);
  report.cell = cell;
  report.pose_times_s = result.pose_times_s;
  report.found = result.front;
  report.knee = result.knee;
  report.why = result.why;
  if (result.present) report.given.push_back(*result.present);
  if (result.closest) report.given.push_back(*result.closest);
  report.given.insert(report.given.end(), result.published.begin(), result.published.end());
  for (const GreedyDesign& greedy : result.greedy) report.given.push_back(greedy.design);
  report.history = result.history;
  DesignerOptions shown = job.options;
  report.options_json = json_of_options(describing(shown)).dump();
  return report;
}

}  // namespace

DesignedLayouts search_layouts(const Cell& cell, const LayoutProblem& problem, const DesignJob& job,
                               const GoOn& go_on, const OptimizerWorkers& workers) {
  DesignedLayouts designed;
  Optimizer optimizer(problem, job.options.optimizer, workers);
  if (job.resume) resume_from_checkpoint(optimizer, job.out / kCheckpoint);
  run(optimizer, job, go_on, designed);
  designed.result = design_result(problem, optimizer.result());
  if (!optimizer.history().empty()) {
    designed.evaluations = optimizer.history().back().evaluations;
    designed.searching_s = optimizer.history().back().seconds;
  }
  write_layouts(cell, job, designed.result);
  write_front(job, designed.result);
  write_layout_report(job.out / "report.html", report_of(cell, job, designed));
  write_file(job.out / "summary.json", summary_of(designed, cell, job.options).dump(2) + "\n");
  return designed;
}

}  // namespace asterism
